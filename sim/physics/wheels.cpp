#include "sim/physics/wheels.h"

#include <cmath>

#include "hal/types/math.h"

namespace sim::physics {

using hal::Vec3;

Vec3 horizontal(double heading) { return {hal::math::cos(heading), hal::math::sin(heading), 0}; }

double lever(const hal::node::devices::Wheel& wheel) {
  return wheel.radius * hal::math::cos(wheel.roller_angle);
}

bool meet_ground(const WheelSphere& wheel, dContact& contact, GroundContact& met) {
  const double depth = wheel.radius - wheel.centre.z;
  met.touches = depth >= 0;
  if (!met.touches) return false;
  contact.geom.depth = depth;
  contact.geom.normal[2] = 1;
  contact.geom.pos[0] = wheel.centre.x;
  contact.geom.pos[1] = wheel.centre.y;
  contact.geom.pos[2] = wheel.centre.z - wheel.radius;
  contact.surface.mode = dContactFDir1 | dContactMu2 | dContactApprox1;
  const double length = std::sqrt(wheel.slip.x * wheel.slip.x + wheel.slip.y * wheel.slip.y);
  met.grip = {-wheel.slip.y / length, wheel.slip.x / length, 0};
  contact.fdir1[0] = met.grip.x;
  contact.fdir1[1] = met.grip.y;
  const dReal* centre = dBodyGetPosition(wheel.body);
  const dReal* p = contact.geom.pos;
  met.arm = {p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
  return true;
}

}  // namespace sim::physics
