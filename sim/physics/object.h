#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "sim/physics/drivetrain.h"
#include "sim/physics/rigid_body.h"
#include "sim/physics/world.h"

namespace sim::physics {

/// A mote or a robot in the world.
struct Object {
  AgentId agent;
  RigidBody rigid;
  std::unique_ptr<Drivetrain> drivetrain;  ///< Null for a mote.
  std::vector<dBodyID> bodies;             ///< Main body first, then wheels.
  std::vector<dGeomID> geometries;         ///< Geometries of the main body.
  std::size_t first_shape = 0;             ///< Its shapes have consecutive indices.
  double friction = 0;
  Contacts contacts;
  hal::Vec3 centre;  ///< m, of the main body's mass, when last found valid
  /// Cached while the body rests, because its angles are costly.
  mutable std::optional<BodyPose> pose;
  bool lost = false;    ///< Tipped over or lost, and reported.
  bool frozen = false;  ///< Removed from the dynamics permanently.

  bool awake() const { return dBodyIsEnabled(rigid.body) != 0; }
  void wake() const {
    for (const dBodyID body : bodies) dBodyEnable(body);
  }
};

/// Radius of a ball around the centre of mass that encloses all geometries. m
double radius_of(const Object& object);

using Objects = std::vector<std::unique_ptr<Object>>;

}  // namespace sim::physics
