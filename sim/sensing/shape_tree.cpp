#include "sim/sensing/shape_tree.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cmath>

namespace sim::sensing {

/// One member: a box with the shape's bounds.
struct Member {
  std::size_t shape;
  std::shared_ptr<fcl::Boxd> box;
  std::unique_ptr<fcl::CollisionObjectd> object;
};

namespace {

using hal::Vec3;
using physics::Shape;
using Node = fcl::detail::NodeBase<fcl::AABBd>;

/// Half the extent of a shape along x and y.
hal::Vec2 extent(const Shape& shape) {
  if (shape.kind == Shape::Kind::kCylinder) return {shape.radius, shape.radius};
  const double c = std::abs(shape.axis.x);
  const double s = std::abs(shape.axis.y);
  return {c * shape.half.x + s * shape.half.y, s * shape.half.x + c * shape.half.y};
}

void place(Member& member, const Shape& shape) {
  const hal::Vec2 half = extent(shape);
  member.box->side = {2 * half.x, 2 * half.y, shape.z_high - shape.z_low};
  member.box->computeLocalAABB();
  member.object->setTranslation(
      {shape.centre.x, shape.centre.y, 0.5 * (shape.z_low + shape.z_high)});
  member.object->computeAABB();
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

bool meets(const fcl::AABBd& bounds, const Vec3& start, const Vec3& slope) {
  double from = 0;
  double to = 1;
  return clip(from, to, {start.x, slope.x, bounds.min_[0], bounds.max_[0]}) &&
         clip(from, to, {start.y, slope.y, bounds.min_[1], bounds.max_[1]}) &&
         clip(from, to, {start.z, slope.z, bounds.min_[2], bounds.max_[2]});
}

/// Walks the tree by bounds only; FCL's own queries would also run its shape tests.
template <class Test>
void walk(const Node* node, const Test& test, std::vector<std::size_t>& found) {
  if (!test(node->bv)) return;
  if (node->isLeaf()) {
    const auto* object = static_cast<const fcl::CollisionObjectd*>(node->data);
    found.push_back(static_cast<const Member*>(object->getUserData())->shape);
    return;
  }
  walk(node->children[0], test, found);
  walk(node->children[1], test, found);
}

}  // namespace

class ShapeTree::Implementation {
 public:
  void build() {
    std::vector<fcl::CollisionObjectd*> objects;
    objects.reserve(members.size());
    for (const Member& member : members) objects.push_back(member.object.get());
    manager.clear();
    manager.registerObjects(objects);
    manager.setup();
  }

  /// The tree's structure depends on its history, but the result must not: ascending order.
  template <class Test>
  void query(const Test& test, std::vector<std::size_t>& found) const {
    if (members.empty()) return;
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    walk(manager.getTree().getRoot(), test, found);
    std::sort(found.begin() + first, found.end());
  }

  std::vector<Member> members;
  fcl::DynamicAABBTreeCollisionManagerd manager;
};

ShapeTree::ShapeTree(std::span<const Shape> shapes, const std::vector<std::size_t>& members)
    : implementation_(std::make_unique<Implementation>()) {
  auto& entries = implementation_->members;
  entries.reserve(members.size());
  for (const std::size_t index : members) {
    const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
    entries.push_back({index, box, std::make_unique<fcl::CollisionObjectd>(box)});
    entries.back().object->setUserData(&entries.back());
    place(entries.back(), shapes[index]);
  }
  if (!entries.empty()) implementation_->build();
}

ShapeTree::~ShapeTree() = default;
ShapeTree::ShapeTree(ShapeTree&&) noexcept = default;
ShapeTree& ShapeTree::operator=(ShapeTree&&) noexcept = default;

void ShapeTree::overlapping(const Region& region, std::vector<std::size_t>& found) const {
  implementation_->query(
      [&](const fcl::AABBd& bounds) {
        return bounds.min_[0] <= region.high.x && bounds.max_[0] >= region.low.x &&
               bounds.min_[1] <= region.high.y && bounds.max_[1] >= region.low.y &&
               bounds.min_[2] <= region.high.z && bounds.max_[2] >= region.low.z;
      },
      found);
}

void ShapeTree::along(const Vec3& from, const Vec3& to, std::vector<std::size_t>& found) const {
  const Vec3 slope = to - from;
  implementation_->query([&](const fcl::AABBd& bounds) { return meets(bounds, from, slope); },
                         found);
}

}  // namespace sim::sensing
