#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/description/stability.h"
#include "hal/devices/robot_description.h"

namespace hal::description {

/// A robot file, or `robot:` of a group of agents. Parts have the names of SDF and URDF: the `link`
/// with its `collision` shapes and their `mass`, the wheels' `joints` with `axis` and `limit`.
/// @param gravity  m/s^2 where it drives: it must not tip over there.
devices::RobotDescription read_robot(config::Mapping in, double gravity = kEarthGravity);
void write_robot(config::Writer& out, const devices::RobotDescription& robot);

/// A mote file, or `mote:` of a group of agents.
devices::MoteDescription read_mote(config::Mapping in);
void write_mote(config::Writer& out, const devices::MoteDescription& mote);

}  // namespace hal::description
