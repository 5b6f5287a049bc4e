#pragma once

#include <vector>

#include "controllers/help/avoidance.h"
#include "hal/api/controller.h"

namespace controllers {

/// How a robot drives to another agent that it can localise: round walls by infrared, past other
/// agents by where they are. Its controller asks for the channels "infrared" and "localisation".
class Travel {
 public:
  /// speed, body_radius, wall_gap, clear_for.
  static std::vector<hal::ParameterSpec> parameters();
  Travel(hal::Robot& robot, const hal::Parameters& parameters);

  /// To be told before the first drive to another agent than before.
  void aim_anew() { avoidance_.aim_anew(); }
  /// Drives on for a control cycle. Blind, before the sensors' first sample, it stays.
  /// @param to  the agent, body frame, m.   @param distance  length of `to`, > 0.
  void drive(hal::Vec2 to, double distance);
  void halt() { (void)robot_.set_body_velocity({}); }

 private:
  hal::Robot& robot_;
  const double clearance_;  ///< m, from the centre to that of an agent in the way.
  Avoidance avoidance_;
};

}  // namespace controllers
