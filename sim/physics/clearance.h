#pragma once

#include <vector>

#include "sim/physics/object.h"
#include "sim/physics/wall_tree.h"

namespace sim::physics {

/// Detects that nothing in a small world can touch yet, so that the broad phase can be skipped.
///
/// A sphere around its centre of mass encloses each object in any orientation. At the last
/// measurement, object i had the gap gap_ij to object j; until it has moved by half of its smallest
/// gap (by all of it towards a wall, which does not move), no sphere can have met another. Then all
/// gaps are measured again: conservative advancement (B. Mirtich, "Impulse-based Dynamic Simulation
/// of Rigid Body Systems", 1996), with distances instead of times.
class Clearance {
 public:
  /// Adds a wall of the world. @pre nothing was measured yet.
  void add_wall(const Shape& wall) { walls_.push_back(wall); }

  /// Prepares the search for walls, if they are many. @pre all were added.
  void settle() {
    if (walls_.size() >= WallTree::kFewestWalls) tree_ = WallTree(walls_);
  }
  /// Of the walls in the order in which they were added; empty: they are few.
  const WallTree& tree() const { return tree_; }

  /// The cost of a measurement is quadratic in the number of objects: beyond this number the broad
  /// phase is cheaper.
  static constexpr std::size_t kMostObjects = 64;
  static bool measures(const Objects& objects) { return objects.size() <= kMostObjects; }

  /// Whether some objects, or an object and a wall, may touch now; true if in doubt.
  bool may_touch(const Objects& objects);

 private:
  struct Ball {
    hal::Vec3 centre;   ///< m, when measured
    double radius = 0;  ///< m, around the centre of mass
    double free = 0;    ///< m, distance that it may move; < 0: it may touch something already
    bool can_move = false;
  };

  bool has_strayed(const Objects& objects) const;
  void measure(const Objects& objects);
  void measure_between(Ball& a, Ball& b) const;
  double gap_to_walls(const Ball& ball) const;

  std::vector<Shape> walls_;
  WallTree tree_;
  std::vector<Ball> balls_;  ///< In the order of the objects.
  bool crowded_ = true;      ///< Some sphere has no free distance.
};

}  // namespace sim::physics
