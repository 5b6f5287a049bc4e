#pragma once

#include <memory>

#include "hal/hardware/drivers/driven_robot.h"
#include "hal/hardware/drivers/infrared.h"
#include "hal/hardware/drivers/settings.h"
#include "hal/hardware/drivers/wheels.h"

namespace hal::hardware {

/// Wheels of a Robotino. The robot stops when it hears no velocity for 200 ms; the driver repeats
/// the last one every period. Odometry comes over a connection of its own, so that a slow answer
/// there holds up no command.
std::unique_ptr<WheelDriver> make_robotino_wheels(const RobotinoSettings& settings,
                                                  const DrivenRobot& robot);

/// The nine infrared sensors of a Robotino as those of `robot`: a sensor of the robot that looks
/// along one of the array's directions is that one; otherwise it gets the nearer of what its two
/// neighbours in the array see.
std::unique_ptr<InfraredDriver> make_robotino_infrared(const RobotinoSettings& settings,
                                                       const devices::RobotDescription& robot);

}  // namespace hal::hardware
