#pragma once

#include "hal/files/config/mapping.h"
#include "hal/robot/agent/robot_file.h"

namespace hal::robot::agent {

/// `wheels:`, `infrared:`, `sensors:`, `limits:` and `on_lost_sensor:` of a robot's file. @pre the
/// file's `robot` is read.
void read_devices(files::config::Mapping& in, RobotFile& file);

/// `localisation:`. @pre the file's address is read.
LocalisationSettings read_localisation(files::config::Mapping in, const RobotFile& file);

}  // namespace hal::robot::agent
