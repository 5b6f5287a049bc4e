#include <variant>

#include "hal/hardware/drivers/iio.h"
#include "hal/hardware/drivers/robotino.h"
#include "hal/hardware/drivers/tmc200.h"
#include "hal/hardware/robot_file.h"

namespace hal::hardware {

std::unique_ptr<WheelDriver> make_wheels(const RobotFile& file) {
  if (const auto* robotino = std::get_if<RobotinoSettings>(&file.wheels)) {
    return make_robotino_wheels(*robotino, {*file.robot, file.limits, file.command_timeout});
  }
  if (const auto* tmc200 = std::get_if<Tmc200Settings>(&file.wheels)) {
    return make_tmc200_wheels(*tmc200, {*file.robot, file.limits, file.command_timeout});
  }
  return nullptr;
}

std::unique_ptr<InfraredDriver> make_infrared(const RobotFile& file) {
  if (const auto* robotino = std::get_if<RobotinoSettings>(&file.infrared)) {
    return make_robotino_infrared(*robotino, *file.robot);
  }
  if (const auto* iio = std::get_if<IioSettings>(&file.infrared)) {
    return make_iio_infrared(*iio, *file.robot);
  }
  return nullptr;
}

}  // namespace hal::hardware
