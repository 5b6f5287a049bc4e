#include "hal/api/controller.h"

/// As little as a controller can do, for benches. A mote's does nothing in its control cycles; a
/// robot's changes its velocity once a second, as the robots of bare ODE do that it is measured
/// beside: at random up to `speed` along each axis, and up to 1 rad/s.
class DriftingMote : public hal::Controller {
 public:
  DriftingMote(hal::Mote&, const hal::Parameters&) {}
};

class DriftingRobot : public hal::Controller {
 public:
  DriftingRobot(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), speed_(parameters["speed"]) {}

  void step() override {
    if (cycle_++ % kCyclesPerChange != 0) return;
    (void)robot_.set_body_velocity(
        {.vx = speed_ * deviate(), .vy = speed_ * deviate(), .omega = deviate()});
  }

 private:
  static constexpr int kCyclesPerChange = 10;

  double deviate() { return 2 * robot_.random().uniform() - 1; }  // -1 .. 1

  hal::Robot& robot_;
  const double speed_;  // m/s
  int cycle_ = 0;
};

BARAKA_CONTROLLER {
  return {.name = "drifter",
          .wants = {},
          .parameters = {{"speed", "m/s", 0.3, 0, 1, "Greatest speed along each axis."}},
          .make_for_mote = hal::make_for_mote<DriftingMote>,
          .make_for_robot = hal::make_for_robot<DriftingRobot>};
}
