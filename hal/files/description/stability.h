#pragma once

#include "hal/node/devices/robot_description.h"
#include "hal/types/geometry.h"

namespace hal::files::description {

/// m/s^2, the default of a scenario.
inline constexpr double kEarthGravity = 9.81;

/// Margin of a robot against tipping over when its motors reverse at full speed, at its weakest
/// side. There two wheels span an edge of the convex hull of all wheels. With the centre of mass at
/// the height h above the ground and at the horizontal distance d inside that edge, an acceleration
/// a lifts the other wheels if a h > g d (moments about the edge).
struct Stability {
  Vec3 centre_of_mass;  ///< m, body frame
  double inside = 0;    ///< m; d of the weakest edge. Negative: the wheels do not carry the robot.
  double lifting = 0;   ///< m/s^2; smallest acceleration that lifts wheels, g d / h.
  /// m/s^2; largest acceleration there that motors, grip and `acceleration` permit.
  double driving = 0;
  bool tips_over = false;  ///< The motors can tip it over that edge.
};

/// @param robot  at least three wheels that make a devices::WheelDrive, and one body part.
/// @param gravity  > 0, m/s^2
Stability stability_of(const node::devices::RobotDescription& robot, double gravity);

}  // namespace hal::files::description
