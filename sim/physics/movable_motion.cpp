#include <cmath>

#include "sim/physics/object.h"

namespace sim::physics {
namespace {

constexpr double kStillWay = 1e-3;   // m
constexpr double kStillTurn = 5e-3;  // rad
constexpr double kStillTime = 0.5;   // s

/// Whether a body is still at about the same pose.
bool is_at(dBodyID body, const Object::Rest& rest) {
  const dReal* p = dBodyGetPosition(body);
  const hal::Vec3 way = hal::Vec3{p[0], p[1], p[2]} - rest.place;
  const dReal* q = dBodyGetQuaternion(body);
  double same = 0;  // cosine of half the angle between the poses
  for (int i = 0; i < 4; ++i) same += q[i] * rest.rotation[static_cast<std::size_t>(i)];
  return hal::dot(way, way) < kStillWay * kStillWay &&
         1 - std::abs(same) < kStillTurn * kStillTurn / 8;
}

Object::Rest rest_at(dBodyID body) {
  const dReal* p = dBodyGetPosition(body);
  const dReal* q = dBodyGetQuaternion(body);
  return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}, 0};
}

}  // namespace

void slide(const Object& movable, const Ground& ground, double seconds) {
  const hal::Vec3 n = ground.normal({movable.centre.x, movable.centre.y});
  const hal::Vec3 slowing = movable.velocity_before - linear_velocity(movable.rigid);
  shift(movable.rigid, 0.5 * seconds * (slowing - hal::dot(slowing, n) * n));
}

void doze(Object& movable, bool near_robot, double seconds) {
  const dBodyID body = movable.rigid.body;
  if (near_robot || !is_at(body, movable.rest)) movable.rest = rest_at(body);
  movable.rest.seconds += seconds;
  if (movable.rest.seconds < kStillTime) return;
  dBodySetLinearVel(body, 0, 0, 0);
  dBodySetAngularVel(body, 0, 0, 0);
  dBodyDisable(body);
}

}  // namespace sim::physics
