#pragma once

#include "hal/node/devices/robot_description.h"
#include "hal/robot/drivers/speed_limits.h"
#include "hal/types/time.h"

namespace hal::robot::drivers {

/// The robot whose wheels a driver turns, and how long a command to them is valid.
struct DrivenRobot {
  const node::devices::RobotDescription& description;
  SpeedLimits limits;
  Duration command_timeout{};  ///< > 0
};

}  // namespace hal::robot::drivers
