#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "sim/physics/drivetrain.h"
#include "sim/physics/rigid_body.h"
#include "sim/physics/sliding.h"
#include "sim/physics/world.h"

namespace sim::physics {

/// A mote, a robot or a movable in the world.
struct Object {
  AgentId agent;                         ///< 0: a movable.
  std::optional<std::uint32_t> movable;  ///< Number of the movable.
  RigidBody rigid;
  std::unique_ptr<Drivetrain> drivetrain;  ///< Null for a mote.
  std::vector<dBodyID> bodies;             ///< Main body first, then wheels.
  std::vector<dGeomID> geometries;         ///< Geometries of the main body.
  std::size_t first_shape = 0;             ///< Its shapes have consecutive indices.
  double friction = 0;
  Rubbing rubbing;            ///< Of a movable.
  hal::Vec3 velocity_before;  ///< m/s of its centre of mass, at the start of the step
  /// Pose near which a movable has been for some time.
  struct Rest {
    hal::Vec3 place;  ///< m, of its centre of mass
    std::array<double, 4> rotation{};
    double seconds = 0;
  };
  Rest rest;
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

/// Corrects the position of a movable that touches nothing but the ground, after a step. ODE moves
/// a body by its velocity after the step; one that slides freely has moved by the mean of those
/// before and after it (trapezoidal rule). So its path has no error of first order in the step.
/// Only along the ground: across it, the ground stops it.
void slide(const Object& movable, const Ground& ground, double seconds);

/// Lets a movable fall asleep, after a step, when for 0.5 s it has stayed within 1 mm and 5 mrad
/// of a pose. By ODE's thresholds of speed alone a stack would rock for seconds, and in a jam no
/// body would fall asleep, because there ODE's count starts anew in each step.
/// @param near_robot  in a group of touching bodies with a robot, which may push it: stays awake.
void doze(Object& movable, bool near_robot, double seconds);

/// Radius of a ball around the centre of mass that encloses all geometries. m
double radius_of(const Object& object);

using Objects = std::vector<std::unique_ptr<Object>>;

}  // namespace sim::physics
