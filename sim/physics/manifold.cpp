#include "sim/physics/manifold.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/physics/rigid_body.h"

namespace sim::physics {
namespace {

using hal::Vec3;

Vec3 place_of(const dContact& contact) {
  return {contact.geom.pos[0], contact.geom.pos[1], contact.geom.pos[2]};
}

/// Moves the contact with the largest score to the place `first`.
template <class Score>
void bring(std::span<dContact> contacts, std::size_t first, Score score) {
  const auto best =
      std::max_element(contacts.begin() + static_cast<std::ptrdiff_t>(first), contacts.end(),
                       [&](const dContact& a, const dContact& b) { return score(a) < score(b); });
  std::swap(contacts[first], *best);
}

}  // namespace

std::size_t choose_support(std::span<dContact> contacts) {
  if (contacts.size() <= kContactsPerPair) return contacts.size();
  bring(contacts, 0, [](const dContact& one) { return one.geom.depth; });
  const Vec3 first = place_of(contacts[0]);
  bring(contacts, 1, [&](const dContact& one) {
    const Vec3 apart = place_of(one) - first;
    return hal::dot(apart, apart);
  });
  const dReal* n = contacts[0].geom.normal;
  const Vec3 across = cross({n[0], n[1], n[2]}, place_of(contacts[1]) - first);
  const auto side = [&](const dContact& one) { return hal::dot(place_of(one) - first, across); };
  bring(contacts, 2, [&](const dContact& one) { return std::abs(side(one)); });
  const double taken = side(contacts[2]) < 0 ? -1 : 1;
  bring(contacts, 3, [&](const dContact& one) { return -taken * side(one); });
  return kContactsPerPair;
}

}  // namespace sim::physics
