#pragma once

#include "hal/config/mapping.h"
#include "hal/devices/robot_description.h"

namespace hal::description {

/// Notes what no single value shows: wheels that cannot drive the robot in every direction or do
/// not carry it, infrared sensors inside its body. @param in  the robot's mapping.
void check_robot(config::Mapping& in, const devices::RobotDescription& robot);

}  // namespace hal::description
