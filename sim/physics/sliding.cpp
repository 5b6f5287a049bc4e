#include "sim/physics/sliding.h"

#include <cmath>

namespace sim::physics {
namespace {

using hal::Vec3;

constexpr double kStill = 1e-6;  // m/s; far above rounding errors, far below the sleep threshold
constexpr double kOnFace = 0.7;  // cosine; a rolling cylinder's axis is at a right angle

Vec3 vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }

Vec3 velocity_at(dBodyID body, const dReal* point) {
  if (body == nullptr) return {};
  dVector3 v;
  dBodyGetPointVel(body, point[0], point[1], point[2], v);
  return vector_of(v);
}

/// Sets the first axis along the part of a vector in the contact's plane. @return false if that is
/// shorter than `least`.
bool set_axis(dContact& contact, const Vec3& along, double least) {
  const Vec3 n = vector_of(contact.geom.normal);
  const Vec3 t = along - hal::dot(along, n) * n;
  const double length = std::sqrt(hal::dot(t, t));
  if (!(length > least)) return false;
  contact.fdir1[0] = t.x / length;
  contact.fdir1[1] = t.y / length;
  contact.fdir1[2] = t.z / length;
  contact.surface.mode |= dContactFDir1;
  return true;
}

}  // namespace

void align_friction(dContact& contact, dBodyID a, dBodyID b, const Rubbing& rubbing) {
  const dReal* point = contact.geom.pos;
  Vec3 slip = velocity_at(a, point) - velocity_at(b, point);
  if (b == nullptr) slip = slip + rubbing.pull;
  if (a == nullptr) slip = slip - rubbing.pull;
  if (!set_axis(contact, slip, kStill)) set_axis(contact, rubbing.push, kStill);
}

void resist_rolling(dContact& contact, dBodyID body, const Rubbing& rubbing) {
  if (rubbing.rolling == 0) return;
  if (!rubbing.is_round) {
    const dReal* r = dBodyGetRotation(body);
    const Vec3 axis{r[2], r[6], r[10]};
    if (std::abs(hal::dot(axis, vector_of(contact.geom.normal))) > kOnFace) return;
  }
  contact.surface.mode |= dContactRolling;
  contact.surface.rho = rubbing.rolling;
}

}  // namespace sim::physics
