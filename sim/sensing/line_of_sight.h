#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "hal/types/geometry.h"
#include "sim/physics/world.h"

namespace sim::sensing {

/// Walls on a straight line.
struct Crossing {
  int walls = 0;         ///< Number of walls that the line passes through.
  double thickness = 0;  ///< Total length inside walls, m.
};

/// Length of the segment between two points that is inside a shape. World frame, m.
double length_inside(const physics::Shape& shape, const hal::Vec3& from, const hal::Vec3& to);

/// The part of the segment that is inside: where it begins and how long it is, m; 0 if there is
/// none.
struct Inside {
  double begin = 0, length = 0;
};
Inside part_inside(const physics::Shape& shape, const hal::Vec3& from, const hal::Vec3& to);

/// Finds the walls between two points, for radio obstacles. Bodies of agents are ignored.
class LineOfSight {
 public:
  /// @param world  all walls have been added to it; not needed after construction.
  explicit LineOfSight(const physics::World& world);
  ~LineOfSight();
  LineOfSight(const LineOfSight&) = delete;
  LineOfSight& operator=(const LineOfSight&) = delete;

  /// @param from,to  m, world frame. Touching a surface without entering it is not a crossing.
  Crossing between(const hal::Vec3& from, const hal::Vec3& to) const;

  /// A wall that the line passes through.
  struct Wall {
    std::size_t index;  ///< Among the walls, in the order in which they were added to the world.
    double thickness;   ///< Length inside it, m.
    double begin;       ///< Distance from `from` at which the line enters it, m.
  };
  /// The walls one by one. Valid until the next call.
  std::span<const Wall> walls_between(const hal::Vec3& from, const hal::Vec3& to) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::sensing
