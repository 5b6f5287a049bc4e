#pragma once

#include "hal/devices/robot_description.h"
#include "hal/hardware/drivers/speed_limits.h"
#include "hal/types/time.h"

namespace hal::hardware {

/// The robot whose wheels a driver turns, and how long a command to them is good.
struct DrivenRobot {
  const devices::RobotDescription& description;
  SpeedLimits limits;
  Duration command_timeout{};  ///< > 0
};

}  // namespace hal::hardware
