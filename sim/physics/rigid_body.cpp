#include "sim/physics/rigid_body.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "hal/types/math.h"

namespace sim::physics {
namespace {

using hal::Vec2;
using hal::Vec3;
namespace devices = hal::node::devices;

constexpr int kAlongZ = 3;

/// Geometry of one part of a chassis, with its pose in the body frame.
struct Part {
  dGeomID geometry;
  Vec3 centre;
  double yaw;
  dMass mass;
};

void require_positive(const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("{}: {}, must be positive", what, value));
}

void require_box(const char* what, const Vec3& size) {
  for (const double length : {size.x, size.y, size.z}) require_positive(what, length);
}

void categorise(dGeomID geometry, unsigned category, unsigned others) {
  dGeomSetCategoryBits(geometry, category);
  dGeomSetCollideBits(geometry, others);
}

Part cylinder_part(const OdeWorld& world, const devices::BodyCylinder& cylinder) {
  const double length = cylinder.z_top - cylinder.z_bottom;
  require_positive("cylinder radius", cylinder.radius);
  require_positive("cylinder length", length);
  require_positive("cylinder mass", cylinder.mass);
  Part part{dCreateCylinder(world.space(), cylinder.radius, length),
            {cylinder.centre.x, cylinder.centre.y, 0.5 * (cylinder.z_bottom + cylinder.z_top)},
            0,
            {}};
  dMassSetCylinderTotal(&part.mass, cylinder.mass, kAlongZ, cylinder.radius, length);
  return part;
}

Part box_part(const OdeWorld& world, const devices::BodyBox& box) {
  require_box("box size", box.size);
  require_positive("box mass", box.mass);
  Part part{dCreateBox(world.space(), box.size.x, box.size.y, box.size.z), box.centre, box.yaw, {}};
  dMassSetBoxTotal(&part.mass, box.mass, box.size.x, box.size.y, box.size.z);
  dMatrix3 rotation;
  set_yaw(rotation, box.yaw);
  dMassRotate(&part.mass, rotation);
  return part;
}

void add_mass(dMass& total, dMass mass, const Vec3& centre) {
  dMassTranslate(&mass, centre.x, centre.y, centre.z);
  dMassAdd(&total, &mass);
}

/// Adds the masses of wheels without a body of their own.
void add_wheels(dMass& total, const devices::RobotDescription& robot) {
  for (const devices::Wheel& wheel : robot.wheels) {
    if (wheel.is_driven() && robot.wheel_level == devices::WheelLevel::kJointed) continue;
    require_positive("wheel mass", wheel.mass);
    require_positive("wheel radius", wheel.radius);
    dMass mass;
    dMassSetSphereTotal(&mass, wheel.mass, wheel.radius);
    add_mass(total, mass, {wheel.position.x, wheel.position.y, wheel.radius});
  }
}

/// Makes a body with its origin at `pose` on the ground and the centre of mass of `mass`.
RigidBody make_body(const OdeWorld& world, dMass mass, const hal::Pose2& pose) {
  RigidBody made{dBodyCreate(world.dynamics()), {mass.c[0], mass.c[1], mass.c[2]}};
  dMassTranslate(&mass, -made.centre_of_mass.x, -made.centre_of_mass.y, -made.centre_of_mass.z);
  dBodySetMass(made.body, &mass);
  stand(made, pose, world.ground());
  return made;
}

void attach(const Part& part, const RigidBody& body) {
  dGeomSetBody(part.geometry, body.body);
  const Vec3 offset = part.centre - body.centre_of_mass;
  dGeomSetOffsetPosition(part.geometry, offset.x, offset.y, offset.z);
  dMatrix3 rotation;
  set_yaw(rotation, part.yaw);
  dGeomSetOffsetRotation(part.geometry, rotation);
  categorise(part.geometry, kBodyBit, kWallBit | kBodyBit | kMoteBit);
}

Vec3 as_vector(const dReal* v) { return {v[0], v[1], v[2]}; }

/// The box stands on the face whose axis is nearest to vertical; the other two axes span its
/// outline.
void refresh_box(Shape& shape, dGeomID geometry) {
  const dReal* r = dGeomGetRotation(geometry);
  dVector3 size;
  dGeomBoxGetLengths(geometry, size);
  unsigned up = 2;
  for (unsigned k = 0; k < 2; ++k)
    if (std::abs(r[8 + k]) > std::abs(r[8 + up])) up = k;
  const unsigned along = (up + 1) % 3;
  const unsigned across = (up + 2) % 3;
  const double length = std::sqrt(r[along] * r[along] + r[4 + along] * r[4 + along]);
  shape.axis = {r[along] / length, r[4 + along] / length};
  shape.half = {0.5 * size[along], 0.5 * size[across]};
  double height = 0;
  for (unsigned k = 0; k < 3; ++k) height += std::abs(r[8 + k]) * 0.5 * size[k];
  const double z = dGeomGetPosition(geometry)[2];
  shape.z_low = z - height;
  shape.z_high = z + height;
}

void refresh_cylinder(Shape& shape, dGeomID geometry) {
  double length = 0;
  dGeomCylinderGetParams(geometry, &shape.radius, &length);
  const double z = dGeomGetPosition(geometry)[2];
  shape.z_low = z - 0.5 * length;
  shape.z_high = z + 0.5 * length;
}

/// Upright within 45 degrees it is a cylinder, else a box around the cylinder that lies on its
/// side.
void refresh_movable_cylinder(Shape& shape, dGeomID geometry) {
  refresh_cylinder(shape, geometry);
  double radius = 0, length = 0;
  dGeomCylinderGetParams(geometry, &radius, &length);
  const dReal* r = dGeomGetRotation(geometry);
  const double level = std::sqrt(r[2] * r[2] + r[6] * r[6]);  // sine of the tilt
  const bool stands = std::abs(r[10]) >= level;
  shape.kind = stands ? Shape::Kind::kCylinder : Shape::Kind::kBox;
  if (!stands) shape.axis = {r[2] / level, r[6] / level};
  shape.half = stands ? Vec2{} : Vec2{0.5 * length, radius};
  const double height = 0.5 * length * std::abs(r[10]) + radius * level;
  const double z = dGeomGetPosition(geometry)[2];
  shape.z_low = z - height;
  shape.z_high = z + height;
}

void refresh_sphere(Shape& shape, dGeomID geometry) {
  shape.radius = dGeomSphereGetRadius(geometry);
  const double z = dGeomGetPosition(geometry)[2];
  shape.z_low = z - shape.radius;
  shape.z_high = z + shape.radius;
}

}  // namespace

void set_yaw(dMatrix3 rotation, double yaw) {
  dRSetIdentity(rotation);
  const double c = hal::math::cos(yaw);
  const double s = hal::math::sin(yaw);
  rotation[0] = c;
  rotation[1] = -s;
  rotation[4] = s;
  rotation[5] = c;
}

void stand(const RigidBody& body, const hal::Pose2& pose, const Ground& ground) {
  const Vec3 place = on(ground, {pose.x, pose.y});
  const Vec3 up = ground.normal({pose.x, pose.y});
  // I + [v] + [v]^2 / (1 + z . n) with v = z x n (O. Rodrigues, 1840)
  const double k = 1 / (1 + up.z);
  const double xx = 1 - k * up.x * up.x, xy = -k * up.x * up.y, yy = 1 - k * up.y * up.y;
  const dMatrix3 slope{xx, xy, up.x, 0, xy, yy, up.y, 0, -up.x, -up.y, up.z, 0};
  dMatrix3 yaw, rotation;
  set_yaw(yaw, pose.theta);
  dMultiply0(rotation, slope, yaw, 3, 3, 3);
  dBodySetRotation(body.body, rotation);
  const Vec3 centre = rotate(body.body, body.centre_of_mass);
  dBodySetPosition(body.body, place.x + centre.x, place.y + centre.y, place.z + centre.z);
}

void lift(const RigidBody& body, double height) { shift(body, {0, 0, height}); }

void shift(const RigidBody& body, const Vec3& way) {
  const dReal* p = dBodyGetPosition(body.body);
  dBodySetPosition(body.body, p[0] + way.x, p[1] + way.y, p[2] + way.z);
}

Vec3 linear_velocity(const RigidBody& body) { return as_vector(dBodyGetLinearVel(body.body)); }

Vec3 position_of(const RigidBody& body) {
  return as_vector(dBodyGetPosition(body.body)) - rotate(body.body, body.centre_of_mass);
}

BodyPose pose_of(const RigidBody& body) {
  const dReal* r = dBodyGetRotation(body.body);
  const dReal* q = dBodyGetQuaternion(body.body);
  BodyPose pose;
  pose.position = position_of(body);
  pose.heading = hal::math::atan2(r[4], r[0]);
  pose.tilt = hal::math::atan2(hal::math::hypot(r[2], r[6]), r[10]);
  pose.quaternion = {q[0], q[1], q[2], q[3]};
  return pose;
}

BodyVelocity velocity_of(const RigidBody& body) {
  const Vec3 spin = as_vector(dBodyGetAngularVel(body.body));
  const Vec3 to_centre = rotate(body.body, body.centre_of_mass);
  return {as_vector(dBodyGetLinearVel(body.body)) - cross(spin, to_centre), spin};
}

double kinetic_energy(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const Vec3 v = as_vector(dBodyGetLinearVel(body));
  const dReal* spin = dBodyGetAngularVel(body);
  dVector3 own;
  dBodyVectorFromWorld(body, spin[0], spin[1], spin[2], own);
  double rotation = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      rotation += own[row] * mass.I[4 * row + column] * own[column];
  return 0.5 * (mass.mass * hal::dot(v, v) + rotation);
}

double potential_energy(dBodyID body) {
  dVector3 gravity;
  dWorldGetGravity(dBodyGetWorld(body), gravity);
  dMass mass;
  dBodyGetMass(body, &mass);
  return -mass.mass * hal::dot(as_vector(gravity), as_vector(dBodyGetPosition(body)));
}

dGeomID make_wall(const OdeWorld& world, const StaticBox& wall) {
  require_box("wall size", wall.size);
  const dGeomID geometry = dCreateBox(world.space(), wall.size.x, wall.size.y, wall.size.z);
  dGeomSetPosition(geometry, wall.centre.x, wall.centre.y, wall.centre.z);
  dMatrix3 rotation;
  set_yaw(rotation, wall.yaw);
  dGeomSetRotation(geometry, rotation);
  categorise(geometry, kWallBit, kBodyBit | kMoteBit);
  return geometry;
}

RigidBody make_mote(const OdeWorld& world, const devices::MoteDescription& mote,
                    const hal::Pose2& pose, Geometries& geometries) {
  require_box("mote size", mote.size);
  require_positive("mote mass", mote.mass);
  dMass mass;
  dMassSetBoxTotal(&mass, mote.mass, mote.size.x, mote.size.y, mote.size.z);
  dMassTranslate(&mass, 0, 0, 0.5 * mote.size.z);
  const RigidBody body = make_body(world, mass, pose);
  const dGeomID geometry = dCreateBox(world.space(), mote.size.x, mote.size.y, mote.size.z);
  dGeomSetBody(geometry, body.body);
  categorise(geometry, kMoteBit, kWallBit | kBodyBit | kMoteBit);
  geometries.all.push_back(geometry);
  return body;
}

RigidBody make_chassis(const OdeWorld& world, const devices::RobotDescription& robot,
                       const hal::Pose2& pose, Geometries& geometries) {
  std::vector<Part> parts;
  for (const auto& cylinder : robot.cylinders) parts.push_back(cylinder_part(world, cylinder));
  for (const auto& box : robot.boxes) parts.push_back(box_part(world, box));
  if (parts.empty())
    throw std::invalid_argument("robot: no cylinder and no box, at least 1 needed");
  dMass total;
  dMassSetZero(&total);
  for (const Part& part : parts) add_mass(total, part.mass, part.centre);
  add_wheels(total, robot);
  const RigidBody body = make_body(world, total, pose);
  for (const Part& part : parts) {
    attach(part, body);
    geometries.all.push_back(part.geometry);
  }
  return body;
}

void refresh(Shape& shape, dGeomID geometry) {
  const dReal* position = dGeomGetPosition(geometry);
  shape.centre = {position[0], position[1]};
  if (dGeomGetClass(geometry) == dBoxClass)
    refresh_box(shape, geometry);
  else if (dGeomGetClass(geometry) == dSphereClass)
    refresh_sphere(shape, geometry);
  else if (shape.is_movable)
    refresh_movable_cylinder(shape, geometry);
  else
    refresh_cylinder(shape, geometry);
}

}  // namespace sim::physics
