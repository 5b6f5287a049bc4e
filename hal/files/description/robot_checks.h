#pragma once

#include "hal/files/config/mapping.h"
#include "hal/node/devices/robot_description.h"

namespace hal::files::description {

/// Notes what no single value shows: wheels that cannot drive the robot in every direction or do
/// not carry it or let it tip over when its motors reverse, infrared sensors inside its body. Warns
/// of robots that cannot turn, or are close to tipping over.
/// @param in  the robot's mapping. @param gravity  m/s^2; 0: nothing tips over.
void check_robot(config::Mapping& in, const node::devices::RobotDescription& robot, double gravity);

}  // namespace hal::files::description
