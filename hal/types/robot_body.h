#pragma once

#include <string>
#include <vector>

#include "hal/types/geometry.h"
#include "hal/types/solid.h"

namespace hal {

/// A wheel of a robot as its file describes it. A positive speed drives the body, at the wheel,
/// towards axle_heading + 90 degrees.
struct BodyWheel {
  bool is_driven = true;    ///< False: a caster, a ball that rolls in any direction.
  Vec2 position;            ///< m, centre of the wheel in the body's frame, `radius` above ground.
  double axle_heading = 0;  ///< rad, direction of the axle in the body's frame.
  /// rad, of a mecanum wheel: from its rolling direction to the axis of the roller on the ground,
  /// counter-clockwise seen from above; 0 for all others.
  double roller_angle = 0;
  double radius = 0;                                  ///< m.
  double max_speed = 0;                               ///< rad/s; 0: it is not driven.
  double max_torque = 0;                              ///< N m at the wheel; 0: it is not driven.
  bool operator==(const BodyWheel&) const = default;  ///< Member by member.
};

/// Shape and wheels of a robot. Body frame: origin on the ground below the middle of the wheels, x
/// forward, y left, z up.
struct RobotBody {
  std::string model;              ///< As the robot's file names it.
  std::vector<Solid> solids;      ///< What collides with others: boxes and cylinders.
  std::vector<BodyWheel> wheels;  ///< In the order of the robot's file, casters included.
  bool operator==(const RobotBody&) const = default;  ///< Member by member.
};

}  // namespace hal
