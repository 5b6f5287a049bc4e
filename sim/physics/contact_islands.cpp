#include "sim/physics/contact_islands.h"

#include <algorithm>

namespace sim::physics {

void ContactIslands::reset(std::size_t count) {
  parents_.resize(count);
  for (std::size_t i = 0; i < count; ++i) parents_[i] = i;
  totals_.assign(count, {});
  empty_ = true;
}

void ContactIslands::add(std::size_t object, int contacts) {
  empty_ = false;
  totals_[root(object)].contacts += contacts;
}

void ContactIslands::join(std::size_t a, std::size_t b, int contacts) {
  empty_ = false;
  const auto [low, high] = std::minmax({root(a), root(b)});
  totals_[low].contacts += contacts;
  if (low == high) return;
  parents_[high] = low;
  totals_[low].contacts += totals_[high].contacts;
  totals_[low].robots += totals_[high].robots;
}

ContactIslands::Total ContactIslands::total(std::size_t object) { return totals_[root(object)]; }

std::size_t ContactIslands::root(std::size_t object) {
  while (parents_[object] != object) {
    parents_[object] = parents_[parents_[object]];
    object = parents_[object];
  }
  return object;
}

}  // namespace sim::physics
