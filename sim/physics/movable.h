#pragma once

#include <string>
#include <variant>

#include "hal/types/geometry.h"
#include "sim/core/obstacle_loss.h"

namespace sim::physics {

struct MovableBox {
  hal::Vec3 size;  ///< m along its own axes, each > 0
  bool operator==(const MovableBox&) const = default;
};

/// A cylinder that stands upright at the start.
struct MovableCylinder {
  double radius = 0;  ///< m, > 0
  double height = 0;  ///< m, > 0
  bool operator==(const MovableCylinder&) const = default;
};

struct MovableSphere {
  double radius = 0;  ///< m, > 0
  bool operator==(const MovableSphere&) const = default;
};

/// A rigid body of even density without a controller: robots push it, sensors see it.
struct Movable {
  std::string name;
  std::variant<MovableBox, MovableCylinder, MovableSphere> form = MovableBox{};
  double mass = 1;       ///< kg, > 0
  hal::Pose2 pose{};     ///< At the start, world frame.
  double elevation = 0;  ///< m, >= 0; of its lowest point above the ground at the start
  hal::Vec2 velocity{};  ///< m/s at the start, world frame
  double friction = 0.6;
  /// Of a sphere or cylinder: the force that keeps it rolling on a plane, as a share of its weight.
  double rolling_resistance = 0.01;
  ObstacleLoss radio_loss{};  ///< Not used by the world itself.
};

/// m along the body's own axes: the box that encloses it.
hal::Vec3 extents(const Movable& movable);

}  // namespace sim::physics
