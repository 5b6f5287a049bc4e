#pragma once

#include "hal/config/mapping.h"
#include "hal/hardware/robot_file.h"

namespace hal::hardware {

/// `wheels:`, `infrared:`, `sensors:`, `limits:` and `on_lost_sensor:` of a robot's file. @pre the
/// file's `robot` is read.
void read_devices(config::Mapping& in, RobotFile& file);

/// `localisation:`. @pre the file's address is read.
LocalisationSettings read_localisation(config::Mapping in, const RobotFile& file);

}  // namespace hal::hardware
