#include "hal/robot/drivers/drivers.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "hal/robot/drivers/iio.h"
#include "hal/robot/drivers/robotino.h"
#include "hal/robot/drivers/tmc200.h"

namespace hal::robot::drivers {
namespace {

using files::description::Fields;
using node::devices::RobotDescription;

template <class Driver>
std::shared_ptr<const DriverChoice<Driver>> none_keys(Fields&, const RobotDescription&) {
  return nullptr;
}

/// Name and keys of all drivers.
constexpr std::array kWheelDrivers{
    DriverKind<WheelDriver>{"none", none_keys<WheelDriver>},
    DriverKind<WheelDriver>{"robotino_rest", robotino_wheels_keys},
    DriverKind<WheelDriver>{"tmc200", tmc200_wheels_keys},
};
constexpr std::array kInfraredDrivers{
    DriverKind<InfraredDriver>{"none", none_keys<InfraredDriver>},
    DriverKind<InfraredDriver>{"robotino_rest", robotino_infrared_keys},
    DriverKind<InfraredDriver>{"iio", iio_infrared_keys},
};

/// @param meaning  description of `driver`.
template <class Driver, std::size_t kSize>
std::shared_ptr<const DriverChoice<Driver>> driver_keys(
    Fields& io, const RobotDescription& robot, const char* meaning,
    const std::array<DriverKind<Driver>, kSize>& kinds) {
  std::vector<std::string> names;
  names.reserve(kSize);
  for (const DriverKind<Driver>& kind : kinds) names.emplace_back(kind.name);
  std::shared_ptr<const DriverChoice<Driver>> choice;
  io.kind({"driver", meaning, "robotino_rest"}, std::move(names),
          [&](Fields& keys, std::size_t kind) { choice = kinds[kind].keys(keys, robot); });
  return choice;
}

}  // namespace

std::shared_ptr<const DriverChoice<WheelDriver>> wheels_keys(Fields& io,
                                                             const RobotDescription& robot) {
  return driver_keys(io, robot,
                     "robotino_rest: REST interface of a Festo Robotino; tmc200: Fraunhofer TMC200 "
                     "motor controller; none: no wheels.",
                     kWheelDrivers);
}

std::shared_ptr<const DriverChoice<InfraredDriver>> infrared_keys(Fields& io,
                                                                  const RobotDescription& robot) {
  auto choice =
      driver_keys(io, robot,
                  "robotino_rest: REST interface of a Festo Robotino; iio: analog-to-digital "
                  "converter of Linux's Industrial I/O; none: no infrared sensors.",
                  kInfraredDrivers);
  if (choice && robot.infrared.empty()) io.mistake("driver", "the robot has no infrared sensors");
  return choice;
}

}  // namespace hal::robot::drivers
