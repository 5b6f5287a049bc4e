#include "sim/physics/movable_body.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

namespace sim::physics {
namespace {

constexpr int kUpright = 3;  // ODE's number of the z axis

void require_movable(bool holds, const Movable& movable, const char* what) {
  if (!holds) throw std::invalid_argument(fmt::format("movable '{}': {}", movable.name, what));
}

bool is_length(double value) { return value > 0 && std::isfinite(value); }
bool is_coefficient(double value) { return value >= 0 && std::isfinite(value); }

void check_movable(const Movable& movable) {
  const hal::Vec3 size = extents(movable);
  require_movable(is_length(size.x) && is_length(size.y) && is_length(size.z), movable,
                  "each size must be positive");
  require_movable(is_length(movable.mass), movable, "its mass must be positive");
  require_movable(is_coefficient(movable.friction) && is_coefficient(movable.rolling_resistance),
                  movable, "its friction and rolling resistance must be 0 or more");
  require_movable(is_coefficient(movable.elevation), movable, "its elevation must be 0 or more");
  require_movable(std::isfinite(movable.velocity.x) && std::isfinite(movable.velocity.y), movable,
                  "its velocity must be finite");
}

/// Mass and geometry of each form, around its centre.
struct MakeForm {
  const OdeWorld& world;
  double kilograms;
  dMass& mass;

  dGeomID operator()(const MovableBox& box) const {
    dMassSetBoxTotal(&mass, kilograms, box.size.x, box.size.y, box.size.z);
    return dCreateBox(world.space(), box.size.x, box.size.y, box.size.z);
  }
  dGeomID operator()(const MovableCylinder& cylinder) const {
    dMassSetCylinderTotal(&mass, kilograms, kUpright, cylinder.radius, cylinder.height);
    return dCreateCylinder(world.space(), cylinder.radius, cylinder.height);
  }
  dGeomID operator()(const MovableSphere& sphere) const {
    dMassSetSphereTotal(&mass, kilograms, sphere.radius);
    return dCreateSphere(world.space(), sphere.radius);
  }
};

struct RollingRadius {
  double operator()(const MovableBox& /*box*/) const { return 0; }
  double operator()(const MovableCylinder& cylinder) const { return cylinder.radius; }
  double operator()(const MovableSphere& sphere) const { return sphere.radius; }
};

}  // namespace

RigidBody make_movable(const OdeWorld& world, const Movable& movable, Geometries& geometries) {
  check_movable(movable);
  dMass mass;
  const dGeomID geometry = std::visit(MakeForm{world, movable.mass, mass}, movable.form);
  const RigidBody body{dBodyCreate(world.dynamics()), {}};
  dBodySetMass(body.body, &mass);
  stand({body.body, {0, 0, 0.5 * extents(movable).z}}, movable.pose, world.ground());
  lift(body, movable.elevation);
  const hal::Vec2 v = movable.velocity;
  const hal::Vec3 n = world.ground().normal({movable.pose.x, movable.pose.y});
  dBodySetLinearVel(body.body, v.x, v.y, -(n.x * v.x + n.y * v.y) / n.z);
  dGeomSetBody(geometry, body.body);
  dGeomSetCategoryBits(geometry, kMoteBit);
  dGeomSetCollideBits(geometry, kWallBit | kBodyBit | kMoteBit);
  geometries.all.push_back(geometry);
  return body;
}

double softness(const Movable& movable) {
  constexpr double kOfAKilogram = 2e-5;
  return kOfAKilogram / movable.mass;
}

double rolling_lever(const Movable& movable) {
  return movable.rolling_resistance * std::visit(RollingRadius{}, movable.form);
}

}  // namespace sim::physics
