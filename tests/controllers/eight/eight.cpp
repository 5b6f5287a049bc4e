#include <numbers>

#include "hal/api/controller.h"

/// Drives a figure of eight of two circles, for the end-to-end tests; a robot that cannot do what
/// is asked says so in its state.
class Eight : public hal::Controller {
 public:
  Eight(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), parameters_(parameters) {}

  void start() override {
    began_ = robot_.now();
    robot_.state("driving");
    step();
  }

  void step() override {
    const double speed = parameters_["speed"];
    const double turn = speed / parameters_["radius"];
    const double around = 2 * std::numbers::pi / turn;  // s
    const double since = hal::to_seconds(robot_.now() - began_);
    hal::Twist2 twist{speed, parameters_["sideways"], since < around ? turn : -turn};
    if (since >= 2 * around) twist = {};
    const auto drive = robot_.set_body_velocity(twist);
    if (!drive || drive->saturated) robot_.state("saturated");
    if (drive && drive->restricted) robot_.state("restricted");
    if (since >= 2 * around) robot_.state("stopped");
  }

 private:
  hal::Robot& robot_;
  const hal::Parameters parameters_;
  hal::Time began_{};
};

BARAKA_CONTROLLER {
  return {.name = "eight",
          .wants = {{"odometry"}},
          .parameters = {{"speed", "m/s", 0.15, 0.01, 10, "Along the circles."},
                         {"radius", "m", 1, 0.01, 100, "Of both circles."},
                         {"sideways", "m/s", 0, -10, 10, "Asked for besides."}},
          .states = {"driving", "saturated", "restricted", "stopped"},
          .make_for_robot = hal::make_for_robot<Eight>};
}
