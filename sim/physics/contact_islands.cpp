#include "sim/physics/contact_islands.h"

#include <algorithm>

namespace sim::physics {

void ContactIslands::reset(std::size_t count) {
  parents_.resize(count);
  for (std::size_t i = 0; i < count; ++i) parents_[i] = i;
  contacts_.assign(count, 0);
}

void ContactIslands::add(std::size_t object, int contacts) { contacts_[root(object)] += contacts; }

void ContactIslands::join(std::size_t a, std::size_t b, int contacts) {
  const auto [low, high] = std::minmax({root(a), root(b)});
  contacts_[low] += contacts;
  if (low == high) return;
  parents_[high] = low;
  contacts_[low] += contacts_[high];
}

int ContactIslands::contacts(std::size_t object) { return contacts_[root(object)]; }

std::size_t ContactIslands::root(std::size_t object) {
  while (parents_[object] != object) {
    parents_[object] = parents_[parents_[object]];
    object = parents_[object];
  }
  return object;
}

}  // namespace sim::physics
