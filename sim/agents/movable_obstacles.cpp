#include "sim/agents/movable_obstacles.h"

#include <algorithm>
#include <cmath>

#include "sim/sensing/line_of_sight.h"

namespace sim::agents {
namespace {

constexpr double kEdge = 2;  // m; of a cell: movables are smaller and links longer

double loss_over(const ObstacleLoss& loss, double metres) {
  return metres > 0 ? loss.per_crossing.value + loss.per_metre * metres : 0;
}

}  // namespace

MovableObstacles::MovableObstacles(const physics::World& world,
                                   const std::vector<physics::Movable>& movables)
    : world_(world), index_(movables.size()), grid_(kEdge) {
  for (std::size_t i = 0; i < movables.size(); ++i) {
    if (movables[i].radio_loss.is_none()) continue;
    index_[i] = static_cast<std::uint32_t>(numbers_.size());
    numbers_.push_back(static_cast<std::uint32_t>(i));
    losses_.push_back(movables[i].radio_loss);
    const hal::Vec3 size = physics::extents(movables[i]);
    largest_ = std::max(largest_, 0.5 * std::sqrt(hal::dot(size, size)));
  }
}

double MovableObstacles::loss(const hal::Vec3& from, const hal::Vec3& to) const {
  if (empty()) return 0;
  if (followed_ != world_.steps()) follow();
  collect(from, to);
  double sum = 0;
  for (const std::uint32_t i : near_) {
    const physics::Shape& shape = world_.movable_shape(numbers_[i]);
    sum += loss_over(losses_[i], sensing::length_inside(shape, from, to));
  }
  return sum;
}

void MovableObstacles::put(std::uint32_t i) const {
  grid_.put(i, world_.movable_shape(numbers_[i]).centre);
}

/// Updates the grid: if one step has passed, only movables that it moved.
void MovableObstacles::follow() const {
  if (followed_ && *followed_ + 1 == world_.steps()) {
    for (const std::uint32_t number : world_.moved_movables())
      if (index_[number]) put(*index_[number]);
  } else {
    for (std::uint32_t i = 0; i < numbers_.size(); ++i) put(i);
  }
  followed_ = world_.steps();
}

/// Movables that may be on the path, each once and in order: those near one of the segments into
/// which it is divided.
void MovableObstacles::collect(const hal::Vec3& from, const hal::Vec3& to) const {
  near_.clear();
  const hal::Vec3 way = to - from;
  const double pieces =
      std::max(std::ceil(std::max(std::abs(way.x), std::abs(way.y)) / kEdge), 1.0);
  for (double k = 0; k < pieces; ++k) {
    const hal::Vec3 a = from + (k / pieces) * way;
    const hal::Vec3 b = from + ((k + 1) / pieces) * way;
    grid_.within({std::min(a.x, b.x) - largest_, std::min(a.y, b.y) - largest_},
                 {std::max(a.x, b.x) + largest_, std::max(a.y, b.y) + largest_}, near_);
  }
  std::ranges::sort(near_);
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
}

}  // namespace sim::agents
