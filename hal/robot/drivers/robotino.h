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
  DeviceTimes times;               ///< Period <= 100 ms: the robot stops after 200 ms of silence.
  // Infrared only. Firmware differs, so the file says what the array gives.
  bool in_volts = false;   ///< Volts instead of metres.
  bool clockwise = false;  ///< Sensor i looks along -40 deg * i instead of 40 deg * i.
  bool operator==(const RobotinoSettings&) const = default;
};

/// Wheels of a Robotino. The robot stops when it hears no velocity for 200 ms; the driver repeats
/// the last one every period. Odometry comes over a connection of its own, so that a slow answer
/// there holds up no command.
std::unique_ptr<WheelDriver> make_robotino_wheels(const RobotinoSettings& settings,
                                                  const DrivenRobot& robot);

/// The nine infrared sensors of a Robotino as those of `robot`: a sensor of the robot that looks
/// along one of the array's directions is that one; otherwise it gets the nearer of what its two
/// neighbours in the array see.
std::unique_ptr<InfraredDriver> make_robotino_infrared(const RobotinoSettings& settings,
                                                       const DrivenRobot& robot);

/// Their keys in a robot's file, and what it asks for.
std::shared_ptr<const DriverChoice<WheelDriver>> robotino_wheels_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);
std::shared_ptr<const DriverChoice<InfraredDriver>> robotino_infrared_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);

}  // namespace hal::robot::drivers
