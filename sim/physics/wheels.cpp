#include "sim/physics/wheels.h"

#include <cmath>

#include "hal/types/math.h"

namespace sim::physics {

using hal::Vec3;

namespace {

void store(const Vec3& vector, dReal* place) {
  place[0] = vector.x;
  place[1] = vector.y;
  place[2] = vector.z;
}

}  // namespace

Vec3 horizontal(double heading) { return {hal::math::cos(heading), hal::math::sin(heading), 0}; }

double lever(const hal::node::devices::Wheel& wheel) {
  return wheel.radius * hal::math::cos(wheel.roller_angle);
}

bool meet_ground(const Ground& ground, const WheelSphere& wheel, dContact& contact,
                 GroundContact& met) {
  const hal::Vec2 below{wheel.centre.x, wheel.centre.y};
  const Vec3 n = ground.normal(below);
  const double depth = wheel.radius - n.z * (wheel.centre.z - ground.height(below));
  met.touches = depth >= 0;
  if (!met.touches) return false;
  contact.geom.depth = depth;
  met.normal = n;
  const Vec3 lowest = wheel.centre - wheel.radius * n;
  store(n, contact.geom.normal);
  store(lowest, contact.geom.pos);
  contact.surface.mode = dContactFDir1 | dContactMu2 | dContactApprox1;
  const Vec3 across = cross(n, wheel.slip);
  const double length = std::sqrt(hal::dot(across, across));
  met.grip = {across.x / length, across.y / length, across.z / length};
  store(met.grip, contact.fdir1);
  const dReal* centre = dBodyGetPosition(wheel.body);
  met.arm = lowest - Vec3{centre[0], centre[1], centre[2]};
  return true;
}

}  // namespace sim::physics
