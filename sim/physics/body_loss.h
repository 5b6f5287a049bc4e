#pragma once

#include <optional>

#include "sim/physics/object.h"

namespace sim::physics {

/// Whether a body is where none should be. Cheap: no trigonometry.
/// @param origin  position_of() it.
std::optional<BodyLoss> loss_of(const RigidBody& body, const hal::Vec3& origin,
                                const Ground& ground);

/// Takes an object out of the dynamics: at rest at `place`, touched by nothing.
void freeze(Object& object, const hal::Vec3& place);

}  // namespace sim::physics
