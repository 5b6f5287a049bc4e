#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "hal/robot/drivers/device_times.h"
#include "hal/robot/drivers/driver_choice.h"
#include "hal/robot/drivers/infrared.h"
#include "hal/robot/drivers/wheels.h"

namespace hal::robot::drivers {

/// Festo Robotino 3 or 4 over its REST interface (wiki.openrobotino.org/Rest_api.html).
struct RobotinoSettings {
  std::string host;  ///< Name or address.
  std::uint16_t port = 80;
  std::string session = "baraka";  ///< `sid` of the requests.
  /// Period <= 100 ms, because the robot stops 200 ms after the last command.
  DeviceTimes times;
  // Infrared only. The contents of the array depend on the firmware, so the file states them.
  bool in_volts = false;   ///< Volts instead of metres.
  bool clockwise = false;  ///< Sensor i is at -40 deg * i instead of 40 deg * i.
  bool operator==(const RobotinoSettings&) const = default;
};

/// Wheels of a Robotino. The robot stops if it receives no velocity for 200 ms; the driver repeats
/// the last one every period. Odometry uses its own connection, so that a slow answer there does
/// not delay commands.
std::unique_ptr<WheelDriver> make_robotino_wheels(const RobotinoSettings& settings,
                                                  const DrivenRobot& robot);

/// Maps the nine infrared sensors of a Robotino to those of `robot`: a sensor of the robot in the
/// direction of one in the array gets its value; any other gets the smaller distance of its two
/// neighbours in the array.
std::unique_ptr<InfraredDriver> make_robotino_infrared(const RobotinoSettings& settings,
                                                       const DrivenRobot& robot);

/// Reads their keys in a robot's file; returns the choice that they describe.
std::shared_ptr<const DriverChoice<WheelDriver>> robotino_wheels_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);
std::shared_ptr<const DriverChoice<InfraredDriver>> robotino_infrared_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);

}  // namespace hal::robot::drivers
