#pragma once

#include "hal/files/description/fields.h"
#include "hal/robot/agent/robot_file.h"

namespace hal::robot::agent {

/// `wheels:`, `infrared:`, `sensors:`, `limits:` and `on_lost_sensor:` of a robot's file. @pre
/// `file.robot` has been read.
void device_keys(files::description::Fields& io, RobotFile& file);

/// `localisation:`. @param file  must have its address and name.
void localisation_keys(files::description::Fields& io, LocalisationSettings& c,
                       const RobotFile& file);

}  // namespace hal::robot::agent
