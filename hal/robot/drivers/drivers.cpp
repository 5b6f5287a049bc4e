#include "hal/robot/drivers/drivers.h"

#include <array>
#include <utility>

#include "hal/robot/drivers/iio.h"
#include "hal/robot/drivers/robotino.h"
#include "hal/robot/drivers/tmc200.h"

namespace hal::robot::drivers {
namespace {

using files::config::Mapping;
using files::config::Option;
using node::devices::RobotDescription;

template <class Driver>
std::shared_ptr<const DriverChoice<Driver>> read_none(Mapping&, const RobotDescription&) {
  return nullptr;
}

/// The one table of drivers: name and reader of each.
constexpr std::array kWheelDrivers{
    DriverKind<WheelDriver>{"none", read_none<WheelDriver>},
    DriverKind<WheelDriver>{"robotino_rest", read_robotino_wheels},
    DriverKind<WheelDriver>{"tmc200", read_tmc200_wheels},
};
constexpr std::array kInfraredDrivers{
    DriverKind<InfraredDriver>{"none", read_none<InfraredDriver>},
    DriverKind<InfraredDriver>{"robotino_rest", read_robotino_infrared},
    DriverKind<InfraredDriver>{"iio", read_iio_infrared},
};

template <class Driver, std::size_t kSize, std::size_t... kIndex>
constexpr auto options(const std::array<DriverKind<Driver>, kSize>& kinds,
                       std::index_sequence<kIndex...>) {
  return std::array{Option<std::size_t>{kinds[kIndex].name, kIndex}...};
}

/// @param meaning  of `driver`.
template <class Driver, std::size_t kSize>
std::shared_ptr<const DriverChoice<Driver>> read_driver(
    Mapping& in, const RobotDescription& robot, const char* meaning,
    const std::array<DriverKind<Driver>, kSize>& kinds) {
  const auto kind = in.choice({"driver", meaning, "robotino_rest"},
                              options(kinds, std::make_index_sequence<kSize>{}));
  if (!kind) return nullptr;
  auto choice = kinds[*kind].read(in, robot);
  in.finish();  // of an unknown driver every key would seem to be wrong
  return choice;
}

}  // namespace

std::shared_ptr<const DriverChoice<WheelDriver>> read_wheels(Mapping in,
                                                             const RobotDescription& robot) {
  return read_driver(
      in, robot,
      "A Festo Robotino's REST interface, a Fraunhofer TMC200 motor controller, or none.",
      kWheelDrivers);
}

std::shared_ptr<const DriverChoice<InfraredDriver>> read_infrared(Mapping in,
                                                                  const RobotDescription& robot) {
  auto choice = read_driver(in, robot,
                            "A Festo Robotino's REST interface, an analog-to-digital "
                            "converter of Linux's Industrial I/O, or none.",
                            kInfraredDrivers);
  if (choice && robot.infrared.empty()) in.mistake("driver", "the robot has no infrared sensors");
  return choice;
}

}  // namespace hal::robot::drivers
