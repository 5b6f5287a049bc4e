#include "sim/physics/body_loss.h"

#include <cmath>

#include "hal/types/math.h"

namespace sim::physics {
namespace {

constexpr double kDeepest = 0.2;   // m; dents made by jams were a few millimetres deep
constexpr double kFarthest = 1e5;  // m
constexpr double kFastest = 1e5;   // m/s

}  // namespace

std::string_view name(BodyLoss loss) {
  switch (loss) {
    case BodyLoss::kTipped:
      return "tipped over";
    case BodyLoss::kBlownUp:
      return "lost: the solver flung it away";
    case BodyLoss::kBelowGround:
      return "lost: it is below the ground";
    case BodyLoss::kFarAway:
      return "lost: it is farther than 100 km away";
  }
  return "lost";
}

std::optional<BodyLoss> loss_of(const RigidBody& body, const hal::Vec3& origin,
                                const Ground& ground) {
  static const double upright = hal::math::cos(1.0);
  const dReal* p = dBodyGetPosition(body.body);
  const dReal* r = dBodyGetRotation(body.body);
  // Written so that NaN fails: later, ODE would abort on such a body.
  const dReal* v = dBodyGetLinearVel(body.body);
  const bool sane = std::abs(v[0]) < kFastest && std::abs(v[1]) < kFastest &&
                    std::abs(v[2]) < kFastest && std::isfinite(p[0] + p[1] + p[2] + r[10]);
  if (!sane) return BodyLoss::kBlownUp;
  const hal::Vec2 place{origin.x, origin.y};
  if (origin.z - ground.height(place) < -kDeepest) return BodyLoss::kBelowGround;
  if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > kFarthest * kFarthest) return BodyLoss::kFarAway;
  if (hal::dot(ground.normal(place), {r[2], r[6], r[10]}) < upright) return BodyLoss::kTipped;
  return std::nullopt;
}

void freeze(Object& object, const hal::Vec3& place) {
  dMatrix3 upright;
  dRSetIdentity(upright);
  for (const dGeomID geometry : object.geometries) dGeomDisable(geometry);
  for (const dBodyID body : object.bodies) {
    dBodySetPosition(body, place.x, place.y, place.z);
    dBodySetRotation(body, upright);
    dBodySetLinearVel(body, 0, 0, 0);
    dBodySetAngularVel(body, 0, 0, 0);
    dBodyDisable(body);
  }
  object.frozen = true;
}

}  // namespace sim::physics
