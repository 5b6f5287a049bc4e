#pragma once

#include <vector>

#include "sim/physics/object.h"

namespace sim::physics {

/// Knows of a small world that nothing in it can touch yet, so that the broad phase need not look.
///
/// A sphere around its centre of mass holds each object however it turns. When the spheres were
/// measured last, object i was gap_ij away from object j; until it has moved by half of its
/// smallest gap (by all of it towards a wall, which stays), no sphere can have met another. Then
/// all are measured again: conservative advancement (B. Mirtich, "Impulse-based Dynamic Simulation
/// of Rigid Body Systems", 1996), with distances instead of times.
class Clearance {
 public:
  /// A wall that was added to the world.
  void add_wall(const Shape& wall) { walls_.push_back(wall); }

  /// Measuring costs the square of the number of objects: beyond this the broad phase is cheaper.
  static constexpr std::size_t kMostObjects = 64;
  static bool measures(const Objects& objects) { return objects.size() <= kMostObjects; }

  /// Whether some objects, or an object and a wall, may touch now; true in doubt.
  bool may_touch(const Objects& objects);

 private:
  struct Ball {
    hal::Vec3 centre;   ///< m, when it was measured
    double radius = 0;  ///< m, around the centre of mass
    double free = 0;    ///< m that it may move; < 0: it may touch something already
    bool can_move = false;
  };

  bool has_strayed(const Objects& objects) const;
  void measure(const Objects& objects);
  void measure_between(Ball& a, Ball& b) const;
  double gap_to_walls(const Ball& ball) const;

  std::vector<Shape> walls_;
  std::vector<Ball> balls_;  ///< Of the objects, in their order.
  bool crowded_ = true;      ///< Some ball has no room.
};

}  // namespace sim::physics
