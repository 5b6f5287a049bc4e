#include "sim/physics/wall_tree.h"

#include <numeric>

namespace sim::physics {
namespace {

Outline outline_of(const Shape& shape) {
  hal::Vec2 half{shape.radius, shape.radius};
  if (shape.kind == Shape::Kind::kBox) {
    const hal::Vec2 axis{std::abs(shape.axis.x), std::abs(shape.axis.y)};
    half = {axis.x * shape.half.x + axis.y * shape.half.y,
            axis.y * shape.half.x + axis.x * shape.half.y};
  }
  return {shape.centre - half, shape.centre + half};
}

void widen(Outline& outline, const Outline& by) {
  outline.low = {std::min(outline.low.x, by.low.x), std::min(outline.low.y, by.low.y)};
  outline.high = {std::max(outline.high.x, by.high.x), std::max(outline.high.y, by.high.y)};
}

bool overlap(const Outline& a, const Outline& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

}  // namespace

WallTree::WallTree(std::span<const Shape> walls) : order_(walls.size()) {
  if (walls.empty()) return;
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Outline> outlines;
  outlines.reserve(walls.size());
  for (const Shape& wall : walls) outlines.push_back(outline_of(wall));
  build(outlines, 0, static_cast<std::uint32_t>(walls.size()));
}

/// Halves the walls by their middles along the longer side.
void WallTree::build(std::span<const Outline> outlines, std::uint32_t first, std::uint32_t count) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Outline outline;
  for (std::uint32_t i = first; i < first + count; ++i) widen(outline, outlines[order_[i]]);
  nodes_[index].outline = outline;
  if (count <= kLeaf) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return;
  }
  const bool by_x = outline.high.x - outline.low.x >= outline.high.y - outline.low.y;
  const auto middle = [&](std::uint32_t wall) {
    const Outline& one = outlines[wall];
    return std::pair(by_x ? one.low.x + one.high.x : one.low.y + one.high.y, wall);
  };
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return middle(a) < middle(b); });
  build(outlines, first, half);
  nodes_[index].other = static_cast<std::uint32_t>(nodes_.size());
  build(outlines, first + half, count - half);
}

void WallTree::overlapping(const Outline& box, std::vector<std::uint32_t>& found) const {
  if (is_empty()) return;
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  std::array<std::uint32_t, kDeepest> open{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::uint32_t index = open[--depth];
    const Node& node = nodes_[index];
    if (!overlap(node.outline, box)) continue;
    if (node.other == 0) {
      found.insert(found.end(), order_.begin() + node.first,
                   order_.begin() + node.first + node.count);
    } else {
      open[depth++] = node.other;
      open[depth++] = index + 1;
    }
  }
  std::sort(found.begin() + before, found.end());
}

}  // namespace sim::physics
