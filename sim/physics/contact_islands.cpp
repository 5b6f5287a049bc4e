#include "sim/physics/contact_islands.h"

#include <algorithm>

namespace sim::physics {

void ContactIslands::add_object(bool is_robot) {
  members_.push_back({members_.size(), {0, is_robot ? 1 : 0}, is_robot, false});
}

void ContactIslands::reset() {
  for (const std::size_t object : touching_) {
    Member& member = members_[object];
    member = {object, {0, member.is_robot ? 1 : 0}, member.is_robot, false};
  }
  touching_.clear();
}

void ContactIslands::note(std::size_t object) {
  if (members_[object].touches) return;
  members_[object].touches = true;
  touching_.push_back(object);
}

void ContactIslands::add(std::size_t object, int contacts) {
  note(object);
  members_[root(object)].total.contacts += contacts;
}

void ContactIslands::join(std::size_t a, std::size_t b, int contacts) {
  note(a);
  note(b);
  const auto [low, high] = std::minmax({root(a), root(b)});
  members_[low].total.contacts += contacts;
  if (low == high) return;
  members_[high].parent = low;
  members_[low].total.contacts += members_[high].total.contacts;
  members_[low].total.robots += members_[high].total.robots;
}

ContactIslands::Total ContactIslands::total(std::size_t object) {
  return members_[root(object)].total;
}

std::size_t ContactIslands::root(std::size_t object) {
  while (members_[object].parent != object) {
    members_[object].parent = members_[members_[object].parent].parent;
    object = members_[object].parent;
  }
  return object;
}

}  // namespace sim::physics
