#pragma once

#include <vector>

#include "hal/node/devices/wheel.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/rigid_body.h"

namespace sim::physics {

/// The ball casters of one robot, at both levels of wheels: spheres that are part of the chassis
/// and slide on the ground with the friction of their balls, `mu` along their x axis and `mu2`
/// across it.
class Casters {
 public:
  /// @param wheels  all wheels of the robot; driven ones are ignored.
  Casters(const RigidBody& chassis, const std::vector<hal::node::devices::Wheel>& wheels);

  /// Adds contact joints with the ground.
  void touch_ground(const OdeWorld& world) const;

 private:
  struct Ball {
    /// Centre relative to the chassis's centre of mass, in the chassis frame [m].
    hal::Vec3 offset;
    hal::Vec3 slip;  ///< Unit vector, body frame of the chassis.
    double radius;
    double mu;
    double mu2;
  };

  RigidBody chassis_;
  std::vector<Ball> balls_;
};

}  // namespace sim::physics
