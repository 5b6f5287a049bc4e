#pragma once

#include "hal/files/config/mapping.h"
#include "hal/node/devices/robot_description.h"

namespace hal::files::description {

/// Records mistakes that involve several values: wheels that cannot drive the robot in every
/// direction, do not carry it or let it tip over when its motors reverse, and infrared sensors
/// inside its body. Warns about robots that cannot turn or are close to tipping over.
/// @param in  the robot's mapping. @param gravity  m/s^2; 0: no check for tipping over.
void check_robot(config::Mapping& in, const node::devices::RobotDescription& robot, double gravity);

}  // namespace hal::files::description
