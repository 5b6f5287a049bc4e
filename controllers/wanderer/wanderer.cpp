#include "hal/api/controller.h"
#include "hal/types/math.h"

/// Drives ahead and turns left as long as anything is near in front of it.
class Wanderer : public hal::Controller {
 public:
  Wanderer(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), speed_(parameters["speed"]) {}

  void step() override {
    const auto infrared = robot_.infrared();
    if (!infrared) return;  // not sampled yet
    hal::Twist2 twist{.vx = speed_};
    for (const auto& [heading, range] : *infrared) {  // range: NaN if nothing is within reach
      if (hal::math::cos(heading) > 0.4 && range < 0.4) twist = {.omega = 1};
    }
    (void)robot_.set_body_velocity(twist);
  }

 private:
  hal::Robot& robot_;
  const double speed_;  // m/s
};

BARAKA_CONTROLLER {
  return {.name = "wanderer",
          .wants = {.channels = {"infrared"}},
          .parameters = {{"speed", "m/s", 0.3, 0, 1, "Speed ahead."}},
          .make_for_robot = hal::make_for_robot<Wanderer>};
}
