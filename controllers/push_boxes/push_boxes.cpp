#include "hal/api/controller.h"

/// Drives ahead for some time, whatever is in the way; then backs off, turns, and starts again.
class PushBoxes : public hal::Controller {
 public:
  PushBoxes(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot),
        speed_(parameters["speed"]),
        ahead_(hal::from_seconds(parameters["ahead"])),
        back_(hal::from_seconds(parameters["back"])),
        turn_(hal::from_seconds(parameters["turn"])) {}

  void step() override {
    const hal::Duration since = robot_.now().time_since_epoch() % (ahead_ + back_ + turn_);
    hal::Twist2 twist{.vx = speed_};
    if (since >= ahead_ + back_)
      twist = {.omega = 1};
    else if (since >= ahead_)
      twist = {.vx = -speed_};
    (void)robot_.set_body_velocity(twist);
  }

 private:
  hal::Robot& robot_;
  const double speed_;  // m/s
  const hal::Duration ahead_, back_, turn_;
};

BARAKA_CONTROLLER {
  return {.name = "push_boxes",
          .parameters = {{"speed", "m/s", 0.3, 0, 1, "Speed ahead and back."},
                         {"ahead", "s", 12, 0.1, 1000, "Time ahead."},
                         {"back", "s", 3, 0, 1000, "Time back."},
                         {"turn", "s", 2, 0, 1000, "Time for which it turns left, at 1 rad/s."}},
          .make_for_robot = hal::make_for_robot<PushBoxes>};
}
