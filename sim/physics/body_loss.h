#pragma once

#include <optional>

#include "sim/physics/object.h"

namespace sim::physics {

/// Whether and how a body is lost. Cheap: no trigonometry.
/// @param origin  position_of(body).
std::optional<BodyLoss> loss_of(const RigidBody& body, const hal::Vec3& origin,
                                const Ground& ground);

/// Takes an object out of the dynamics permanently: at rest at `place`, without contacts.
void freeze(Object& object, const hal::Vec3& place);

}  // namespace sim::physics
