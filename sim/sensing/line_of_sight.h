#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "hal/types/geometry.h"
#include "sim/physics/world.h"

namespace sim::sensing {

/// What a straight line meets.
struct Crossing {
  int walls = 0;         ///< Walls that the line passes through.
  double thickness = 0;  ///< m inside walls, together.
};

/// m of the way from one point to another inside a shape. World frame, m.
double length_inside(const physics::Shape& shape, const hal::Vec3& from, const hal::Vec3& to);

/// Counts the fixed things between two points, for radio obstacles. Bodies of agents do not count.
class LineOfSight {
 public:
  /// @param world  all walls were added to it; not needed afterwards.
  explicit LineOfSight(const physics::World& world);
  ~LineOfSight();
  LineOfSight(const LineOfSight&) = delete;
  LineOfSight& operator=(const LineOfSight&) = delete;

  /// @param from, to  m, world frame. Touching a surface without entering it is no crossing.
  Crossing between(const hal::Vec3& from, const hal::Vec3& to) const;

  /// One wall that the line passes through.
  struct Wall {
    std::size_t index;  ///< Among the walls, in the order in which they were added to the world.
    double thickness;   ///< m inside it.
  };
  /// The same one by one. Good until the next call.
  std::span<const Wall> walls_between(const hal::Vec3& from, const hal::Vec3& to) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::sensing
