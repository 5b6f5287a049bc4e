#pragma once

#include "hal/node/devices/robot_description.h"
#include "hal/types/geometry.h"

namespace hal::files::description {

/// m/s^2. Robots stand on the Earth unless a scenario says otherwise.
inline constexpr double kEarthGravity = 9.81;

/// How far a robot on its wheels is from tipping over when its motors reverse, at full speed, away
/// from the side where it is weakest. At that side two wheels span an edge of the area between all
/// wheels; with the centre of mass a height h above the ground and, seen from above, d inside that
/// edge, an acceleration a lifts the other wheels if a h > g d.
struct Stability {
  Vec3 centre_of_mass;  ///< m, body frame
  double inside = 0;    ///< m; d of the nearest edge. Negative: the wheels do not carry the robot.
  double lifting = 0;   ///< m/s^2; least acceleration that lifts wheels, g d / h.
  double driving = 0;   ///< m/s^2; what motors, grip and `acceleration` allow there at most.
  bool tips_over = false;  ///< The motors can turn it over that edge.
};

/// @param robot  at least three wheels, which make a devices::WheelDrive, and one body part.
/// @param gravity  > 0, m/s^2
Stability stability_of(const node::devices::RobotDescription& robot, double gravity);

}  // namespace hal::files::description
