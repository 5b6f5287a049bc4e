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
  std::unique_ptr<Drivetrain> drivetrain;  ///< Null: a mote.
  std::vector<dBodyID> bodies;             ///< Main body first, then wheels.
  std::vector<dGeomID> geometries;         ///< Of the main body.
  std::size_t first_shape = 0;             ///< Their shapes follow one another.
  double friction = 0;
  Contacts contacts;
  hal::Vec3 centre;                      ///< m, of the main body's mass, when it was last seen sane
  mutable std::optional<BodyPose> pose;  ///< Kept while the body rests: its angles cost.
  bool lost = false;                     ///< Tipped over or lost: it has been noted.
  bool frozen = false;                   ///< Out of the dynamics for good.

  bool awake() const { return dBodyIsEnabled(rigid.body) != 0; }
  void wake() const {
    for (const dBodyID body : bodies) dBodyEnable(body);
  }
};

/// Of a ball around the centre of mass that holds all geometries. m
double radius_of(const Object& object);

using Objects = std::vector<std::unique_ptr<Object>>;

}  // namespace sim::physics
