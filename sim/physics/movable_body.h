#pragma once

#include "sim/physics/movable.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/rigid_body.h"

namespace sim::physics {

/// Makes ODE's body and its one geometry; the origin of the body is its centre.
/// @throws std::invalid_argument  a size, mass, friction or velocity is not possible.
RigidBody make_movable(const OdeWorld& world, const Movable& movable, Geometries& geometries);

/// ODE's CFM of the contacts of a movable, inverse to its mass: it sinks in by some micrometres,
/// whatever its mass. In rigid contacts stacks rock for seconds.
double softness(const Movable& movable);

/// m; lever of the torque per newton of load that slows a movable down when it rolls: 0 for a box.
double rolling_lever(const Movable& movable);

}  // namespace sim::physics
