#pragma once

#include <ode/ode.h>

#include "hal/node/devices/robot_description.h"
#include "hal/types/geometry.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/world.h"

namespace sim::physics {

/// What contacts need to know of the owner of a geometry; attached to the geometry.
struct Solid {
  enum class Kind : std::uint8_t { kWall, kRobot, kMote, kMovable };
  Kind kind = Kind::kWall;
  std::size_t object = 0;  ///< Index among the world's moving objects; unused for walls.
  double friction = 0;
};

/// An ODE body whose centre of mass is not its origin.
struct RigidBody {
  dBodyID body = nullptr;
  hal::Vec3 centre_of_mass;  ///< m, in the frame of the origin
};

/// Sets a rotation about the vertical in ODE's format, without libm's sine.
void set_yaw(dMatrix3 rotation, double yaw);

inline hal::Vec3 cross(const hal::Vec3& a, const hal::Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Transforms a vector from the body frame to the world frame.
inline hal::Vec3 rotate(dBodyID body, const hal::Vec3& vector) {
  const dReal* r = dBodyGetRotation(body);
  return {r[0] * vector.x + r[1] * vector.y + r[2] * vector.z,
          r[4] * vector.x + r[5] * vector.y + r[6] * vector.z,
          r[8] * vector.x + r[9] * vector.y + r[10] * vector.z};
}

/// Places a body upright on the ground with its origin at `pose`: rotated by its heading, then by
/// the smallest rotation that takes the vertical to the ground's normal.
void stand(const RigidBody& body, const hal::Pose2& pose, const Ground& ground);

/// Raises a body vertically. m
void lift(const RigidBody& body, double height);
/// Moves a body. m
void shift(const RigidBody& body, const hal::Vec3& way);

BodyPose pose_of(const RigidBody& body);
hal::Vec3 position_of(const RigidBody& body);
BodyVelocity velocity_of(const RigidBody& body);
hal::Vec3 linear_velocity(const RigidBody& body);  ///< m/s of the centre of mass

/// Energies of a body, J. The potential energy is 0 for a centre of mass at the world's origin.
double kinetic_energy(dBodyID body);
double potential_energy(dBodyID body);

/// Geometries of one body, in order of creation.
struct Geometries {
  std::vector<dGeomID> all;
};
/// Each of these makes ODE's body or geometry at a pose, and `geometries` lists what was made.
/// Sizes and masses are checked. @throws std::invalid_argument
dGeomID make_wall(const OdeWorld& world, const StaticBox& wall);
RigidBody make_mote(const OdeWorld& world, const hal::node::devices::MoteDescription& mote,
                    const hal::Pose2& pose, Geometries& geometries);
RigidBody make_chassis(const OdeWorld& world, const hal::node::devices::RobotDescription& robot,
                       const hal::Pose2& pose, Geometries& geometries);

/// Sets `shape` to the upright shape nearest to a geometry. @param shape  the owner is kept, and
/// the kind, except that of a movable cylinder: lying on its side it is a box.
void refresh(Shape& shape, dGeomID geometry);

}  // namespace sim::physics
