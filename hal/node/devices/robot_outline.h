#pragma once

#include "hal/node/devices/robot_description.h"
#include "hal/types/robot_body.h"

namespace hal::node::devices {

/// What controllers and viewers see of a robot's body.
RobotBody body_of(const RobotDescription& robot);

}  // namespace hal::node::devices
