#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/robot_description.h"

namespace sim::scenario {

/// A robot file, or `robot:` of a group of agents. Parts have the names of SDF and URDF: the `link`
/// with its `collision` shapes and their `mass`, the wheels' `joints` with `axis` and `limit`.
hal::devices::RobotDescription read_robot(hal::config::Mapping in);
void write_robot(hal::config::Writer& out, const hal::devices::RobotDescription& robot);

/// A mote file, or `mote:` of a group of agents.
hal::devices::MoteDescription read_mote(hal::config::Mapping in);
void write_mote(hal::config::Writer& out, const hal::devices::MoteDescription& mote);

}  // namespace sim::scenario
