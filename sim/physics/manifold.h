#pragma once

#include <ode/ode.h>

#include <span>

namespace sim::physics {

inline constexpr std::size_t kContactsPerPair = 4;

/// Moves the contacts that support best to the front: the deepest, the one farthest from it, the
/// one farthest from the line through these, and the one farthest on the other side of that line.
/// ODE reports up to 16 contacts between a cylinder and a box in the order of the outline, and the
/// first four may all be on one side of the centre of mass. @return how many there are, at most
/// kContactsPerPair.
std::size_t choose_support(std::span<dContact> contacts);

}  // namespace sim::physics
