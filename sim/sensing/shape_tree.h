#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/physics/shape.h"
#include "sim/sensing/sector_query.h"

namespace sim::sensing {

/// Bounding volume tree over some of a world's shapes that do not move; it returns candidates,
/// which the caller tests exactly. Wraps FCL's dynamic AABB tree; no other file uses FCL.
class ShapeTree {
 public:
  /// @param members  indices into `shapes` of the tree's shapes.
  ShapeTree(std::span<const physics::Shape> shapes, const std::vector<std::size_t>& members);
  ~ShapeTree();
  ShapeTree(ShapeTree&&) noexcept;
  ShapeTree& operator=(ShapeTree&&) noexcept;

  /// Appends the members whose bounds intersect a box, in ascending order.
  void overlapping(const Region& region, std::vector<std::size_t>& found) const;

  /// Appends the members whose bounds intersect a segment, in ascending order.
  void along(const hal::Vec3& from, const hal::Vec3& to, std::vector<std::size_t>& found) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::sensing
