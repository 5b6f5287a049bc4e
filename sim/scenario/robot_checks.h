#pragma once

#include "hal/config/mapping.h"
#include "hal/devices/robot_description.h"

namespace sim::scenario {

/// Notes what no single value shows: wheels that cannot drive the robot in every direction or do
/// not carry it, infrared sensors inside its body. @param in  the robot's mapping.
void check_robot(hal::config::Mapping& in, const hal::devices::RobotDescription& robot);

}  // namespace sim::scenario
