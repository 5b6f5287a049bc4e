#pragma once

#include "hal/files/config/mapping.h"
#include "hal/files/description/fields.h"
#include "hal/files/description/stability.h"
#include "hal/node/devices/robot_description.h"

namespace hal::files::description {

/// A robot file, or `robot:` of a group of agents. Parts have the names of SDF and URDF: the `link`
/// with its `collision` shapes and their `mass`, the wheels' `joints` with `axis` and `limit`.
/// @param gravity  m/s^2 in the scenario; a robot that would tip over there is a mistake.
node::devices::RobotDescription read_robot(config::Mapping in, double gravity = kEarthGravity);
/// Only its keys, without the check that the robot does not tip over.
void keys_of(Fields& io, node::devices::RobotDescription& robot);

/// A mote file, or `mote:` of a group of agents.
node::devices::MoteDescription read_mote(config::Mapping in);
void keys_of(Fields& io, node::devices::MoteDescription& mote);

}  // namespace hal::files::description
