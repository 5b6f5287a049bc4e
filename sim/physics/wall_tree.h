#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/physics/shape.h"

namespace sim::physics {

/// Smallest upright box around a shape, seen from above, or around several. m
struct Outline {
  hal::Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  hal::Vec2 high{-std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()};
};

/// Finds walls near a point, a box or a ray among many: a binary tree of upright boxes around them
/// (J. H. Clark, "Hierarchical geometric models for visible surface algorithms", 1976). What it
/// returns does not depend on the shape of the tree.
class WallTree {
 public:
  /// With fewer walls, looking at each of them is faster.
  static constexpr std::size_t kFewestWalls = 64;

  WallTree() = default;
  /// @param walls  are referred to by their index here.
  explicit WallTree(std::span<const Shape> walls);

  bool is_empty() const { return nodes_.empty(); }

  /// Appends the walls whose outlines have a point in a box, in ascending order.
  void overlapping(const Outline& box, std::vector<std::uint32_t>& found) const;

  /// The smallest distance(wall) of all walls; infinite: there are none.
  /// @param distance  not below the horizontal distance from `point` to the wall's outline, m
  template <class Distance>
  double nearest(hal::Vec2 point, const Distance& distance) const;

  /// The smallest hit(wall) of the walls that a ray may meet; infinite: there are none.
  /// @param direction  unit vector
  /// @param hit  distance along the ray, m; infinite: it misses. Not below the distance to the
  ///   wall's outline.
  /// @param reach  m; hits beyond it may be missed.
  template <class Hit>
  double first(hal::Vec2 origin, hal::Vec2 direction, double reach, const Hit& hit) const;

 private:
  static constexpr std::uint32_t kLeaf = 4;    ///< Most walls of a leaf.
  static constexpr std::size_t kDeepest = 64;  ///< Levels halve the walls.
  static constexpr double kDoubt = 1e-9;       ///< m, above all rounding

  /// An inner node's children are the next node and `other`.
  struct Node {
    Outline outline;
    std::uint32_t other = 0;  ///< 0: a leaf.
    std::uint32_t first = 0, count = 0;  ///< In order_, of a leaf.
  };
  void build(std::span<const Outline> outlines, std::uint32_t first, std::uint32_t count);

  static double distance(const Outline& outline, hal::Vec2 point) {
    const double x = std::max({outline.low.x - point.x, point.x - outline.high.x, 0.0});
    const double y = std::max({outline.low.y - point.y, point.y - outline.high.y, 0.0});
    return std::sqrt(x * x + y * y);
  }

  std::vector<Node> nodes_;  ///< The root first.
  std::vector<std::uint32_t> order_;
};

/// Visits the nearer child first, and no node that cannot have less than was found.
template <class Distance>
double WallTree::nearest(hal::Vec2 point, const Distance& distance_to) const {
  double best = std::numeric_limits<double>::infinity();
  if (is_empty()) return best;
  std::array<std::pair<double, std::uint32_t>, kDeepest> open;
  std::size_t depth = 0;
  open[depth++] = {0.0, 0};
  while (depth > 0) {
    const auto [bound, index] = open[--depth];
    if (bound - kDoubt > best) continue;
    const Node& node = nodes_[index];
    if (node.other == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        best = std::min(best, distance_to(order_[i]));
      continue;
    }
    std::pair near{distance(nodes_[index + 1].outline, point), index + 1};
    std::pair far{distance(nodes_[node.other].outline, point), node.other};
    if (far.first < near.first) std::swap(near, far);
    open[depth++] = far;
    open[depth++] = near;
  }
  return best;
}

template <class Hit>
double WallTree::first(hal::Vec2 origin, hal::Vec2 direction, double reach, const Hit& hit) const {
  double best = std::numeric_limits<double>::infinity();
  if (is_empty()) return best;
  const hal::Vec2 inverse{1 / direction.x, 1 / direction.y};
  // Where the ray enters an outline; infinite: it does not. A comparison with NaN, of a ray along a
  // side, leaves the interval as it is.
  const auto entry = [&](const Outline& outline) {
    const double x0 = (outline.low.x - kDoubt - origin.x) * inverse.x;
    const double x1 = (outline.high.x + kDoubt - origin.x) * inverse.x;
    const double y0 = (outline.low.y - kDoubt - origin.y) * inverse.y;
    const double y1 = (outline.high.y + kDoubt - origin.y) * inverse.y;
    const double from = std::max(std::max(0.0, std::min(x0, x1)), std::min(y0, y1));
    const double to = std::min(std::min(reach, std::max(x0, x1)), std::max(y0, y1));
    return from > to ? std::numeric_limits<double>::infinity() : from;
  };
  std::array<std::pair<double, std::uint32_t>, kDeepest> open;
  std::size_t depth = 0;
  open[depth++] = {entry(nodes_.front().outline), 0};
  while (depth > 0) {
    const auto [bound, index] = open[--depth];
    if (bound == std::numeric_limits<double>::infinity() || bound - kDoubt > best) continue;
    const Node& node = nodes_[index];
    if (node.other == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        best = std::min(best, hit(order_[i]));
      continue;
    }
    std::pair near{entry(nodes_[index + 1].outline), index + 1};
    std::pair far{entry(nodes_[node.other].outline), node.other};
    if (far.first < near.first) std::swap(near, far);
    open[depth++] = far;
    open[depth++] = near;
  }
  return best;
}

}  // namespace sim::physics
