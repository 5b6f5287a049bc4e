#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

/// Finds walls near a point or in a box among many: a binary tree of upright boxes around them
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

  /// Calls visit(wall) for the walls, those in nearer parts of the tree first.
  /// @param skips  skips(outline, distance): whether the walls in an outline, which is so far from
  ///   `point` [m], are left out
  template <class Skips, class Visit>
  void visit(hal::Vec2 point, const Skips& skips, const Visit& visit) const;

 private:
  static constexpr std::uint32_t kLeaf = 4;    ///< Most walls of a leaf.
  static constexpr std::size_t kDeepest = 64;  ///< Levels halve the walls.
  static constexpr double kDoubt = 1e-9;       ///< m, above all rounding

  /// An inner node's children are the next node and `other`.
  struct Node {
    Outline outline;
    std::uint32_t other = 0;             ///< 0: a leaf.
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

template <class Skips, class Visit>
void WallTree::visit(hal::Vec2 point, const Skips& skips, const Visit& visit) const {
  if (is_empty()) return;
  std::array<std::pair<double, std::uint32_t>, kDeepest> open;
  std::size_t depth = 0;
  open[depth++] = {distance(nodes_.front().outline, point), 0};
  while (depth > 0) {
    const auto [away, index] = open[--depth];
    const Node& node = nodes_[index];
    if (skips(node.outline, away)) continue;
    if (node.other == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
      continue;
    }
    std::pair near{distance(nodes_[index + 1].outline, point), index + 1};
    std::pair far{distance(nodes_[node.other].outline, point), node.other};
    if (far.first < near.first) std::swap(near, far);
    open[depth++] = far;
    open[depth++] = near;
  }
}

template <class Distance>
double WallTree::nearest(hal::Vec2 point, const Distance& distance_to) const {
  double best = std::numeric_limits<double>::infinity();
  visit(
      point, [&](const Outline& /*outline*/, double away) { return away - kDoubt > best; },
      [&](std::uint32_t wall) { best = std::min(best, distance_to(wall)); });
  return best;
}

}  // namespace sim::physics
