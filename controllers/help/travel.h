#pragma once

#include <vector>

#include "controllers/help/avoidance.h"
#include "hal/api/controller.h"

namespace controllers {

/// Drives a robot to another agent that it can localise: around walls by infrared, and past other
/// agents by their positions. Its controller must subscribe to the channels "infrared" and
/// "localisation".
class Travel {
 public:
  /// Parameters speed, body_radius, wall_gap, clear_for.
  static std::vector<hal::ParameterSpec> parameters();
  Travel(hal::Robot& robot, const hal::Parameters& parameters);

  /// Call before the first drive() to a different agent.
  void aim_anew() { avoidance_.aim_anew(); }
  /// Drives for one control cycle. Stands still without sensor data, before the first sample.
  /// @param to  the agent, body frame, m.   @param distance  length of `to`, > 0.
  void drive(hal::Vec2 to, double distance);
  void halt() { (void)robot_.set_body_velocity({}); }

 private:
  hal::Robot& robot_;
  const double clearance_;  ///< m, from centre to centre of an agent in the way.
  Avoidance avoidance_;
};

}  // namespace controllers
