#include "sim/physics/wheels.h"

#include <cmath>

namespace sim::physics {

using hal::Vec3;

bool meet_ground(const OdeWorld& world, dGeomID sphere, const Vec3& axle, dContact& contact,
                 GroundContact& met) {
  met.touches = dCollide(sphere, world.ground(), 1, &contact.geom, sizeof contact) != 0;
  if (!met.touches) return false;
  contact.surface.mode = dContactFDir1 | dContactMu2 | dContactApprox1;
  const dReal* n = contact.geom.normal;
  const Vec3 rolling{n[1] * axle.z - n[2] * axle.y, n[2] * axle.x - n[0] * axle.z,
                     n[0] * axle.y - n[1] * axle.x};
  const double length = std::sqrt(dot(rolling, rolling));
  met.rolling = {rolling.x / length, rolling.y / length, rolling.z / length};
  contact.fdir1[0] = met.rolling.x;
  contact.fdir1[1] = met.rolling.y;
  contact.fdir1[2] = met.rolling.z;
  const dReal* p = contact.geom.pos;
  const dBodyID body = dGeomGetBody(sphere);
  const dReal* centre = dBodyGetPosition(body);
  met.arm = {p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
  met.velocity = material_velocity(body, met.arm);
  return true;
}

Vec3 material_velocity(dBodyID body, const Vec3& arm) {
  const dReal* v = dBodyGetLinearVel(body);
  const dReal* w = dBodyGetAngularVel(body);
  return {v[0] + w[1] * arm.z - w[2] * arm.y, v[1] + w[2] * arm.x - w[0] * arm.z,
          v[2] + w[0] * arm.y - w[1] * arm.x};
}

}  // namespace sim::physics
