#include "sim/sensing/shape_tree.h"

#include <fcl/broadphase/detail/hierarchy_tree.h>

#include <algorithm>
#include <cmath>

// FCL's headers say that its library has this class. Made here, it is all that the tree needs, and
// no program loads a library whose 29,000 relocations are an eighth of what its start takes.
template class fcl::AABB<double>;

namespace sim::sensing {

namespace {

using hal::Vec3;
using physics::Shape;
using Bounds = fcl::AABB<double>;
using Tree = fcl::detail::HierarchyTree<Bounds>;
using Node = fcl::detail::NodeBase<Bounds>;

/// Half the extent of a shape along x and y.
hal::Vec2 extent(const Shape& shape) {
  if (shape.kind != Shape::Kind::kBox) return {shape.radius, shape.radius};
  const double c = std::abs(shape.axis.x);
  const double s = std::abs(shape.axis.y);
  return {c * shape.half.x + s * shape.half.y, s * shape.half.x + c * shape.half.y};
}

Bounds bounds_of(const Shape& shape) {
  const hal::Vec2 half = extent(shape);
  const hal::Vec2 centre{shape.centre.x, shape.centre.y};
  Bounds bounds;
  bounds.min_ = {centre.x - half.x, centre.y - half.y, shape.z_low};
  bounds.max_ = {centre.x + half.x, centre.y + half.y, shape.z_high};
  return bounds;
}

/// Narrows [from, to] to where start + t * slope lies in low .. high.
bool clip(double& from, double& to, const std::array<double, 4>& line) {
  const auto [start, slope, low, high] = line;
  if (slope == 0) return start >= low && start <= high;
  const double a = (low - start) / slope;
  const double b = (high - start) / slope;
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
  return from <= to;
}

bool meets(const Bounds& bounds, const Vec3& start, const Vec3& slope) {
  double from = 0;
  double to = 1;
  return clip(from, to, {start.x, slope.x, bounds.min_[0], bounds.max_[0]}) &&
         clip(from, to, {start.y, slope.y, bounds.min_[1], bounds.max_[1]}) &&
         clip(from, to, {start.z, slope.z, bounds.min_[2], bounds.max_[2]});
}

template <class Test>
void walk(const Node* node, const Test& test, std::vector<std::size_t>& found) {
  if (!test(node->bv)) return;
  if (node->isLeaf()) {
    found.push_back(*static_cast<const std::size_t*>(node->data));
    return;
  }
  walk(node->children[0], test, found);
  walk(node->children[1], test, found);
}

}  // namespace

class ShapeTree::Implementation {
 public:
  Implementation(std::span<const Shape> shapes, const std::vector<std::size_t>& members)
      : members_(members) {
    for (std::size_t& member : members_) tree_.insert(bounds_of(shapes[member]), &member);
    tree_.balanceTopdown();
  }

  /// The tree's structure depends on its history, but the result must not: ascending order.
  template <class Test>
  void query(const Test& test, std::vector<std::size_t>& found) const {
    if (tree_.empty()) return;
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    walk(tree_.getRoot(), test, found);
    std::sort(found.begin() + first, found.end());
  }

 private:
  std::vector<std::size_t> members_;  // the tree's leaves point to them
  Tree tree_;
};

ShapeTree::ShapeTree(std::span<const Shape> shapes, const std::vector<std::size_t>& members)
    : implementation_(std::make_unique<Implementation>(shapes, members)) {}

ShapeTree::~ShapeTree() = default;
ShapeTree::ShapeTree(ShapeTree&&) noexcept = default;
ShapeTree& ShapeTree::operator=(ShapeTree&&) noexcept = default;

void ShapeTree::overlapping(const Region& region, std::vector<std::size_t>& found) const {
  implementation_->query(
      [&](const Bounds& bounds) {
        return bounds.min_[0] <= region.high.x && bounds.max_[0] >= region.low.x &&
               bounds.min_[1] <= region.high.y && bounds.max_[1] >= region.low.y &&
               bounds.min_[2] <= region.high.z && bounds.max_[2] >= region.low.z;
      },
      found);
}

void ShapeTree::along(const Vec3& from, const Vec3& to, std::vector<std::size_t>& found) const {
  const Vec3 slope = to - from;
  implementation_->query([&](const Bounds& bounds) { return meets(bounds, from, slope); }, found);
}

}  // namespace sim::sensing
