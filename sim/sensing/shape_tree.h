#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/physics/shape.h"
#include "sim/sensing/sector_query.h"

namespace sim::sensing {

/// Bounding volume tree over some of a world's shapes that do not move; answers with candidates,
/// which the caller tests exactly. FCL's dynamic AABB tree underneath; no other file sees FCL.
class ShapeTree {
 public:
  /// @param members  indices into `shapes` of those that the tree holds.
  ShapeTree(std::span<const physics::Shape> shapes, const std::vector<std::size_t>& members);
  ~ShapeTree();
  ShapeTree(ShapeTree&&) noexcept;
  ShapeTree& operator=(ShapeTree&&) noexcept;

  /// Appends the members whose bounds meet a box, ascending.
  void overlapping(const Region& region, std::vector<std::size_t>& found) const;

  /// Appends the members whose bounds meet a segment, ascending.
  void along(const hal::Vec3& from, const hal::Vec3& to, std::vector<std::size_t>& found) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::sensing
