#include <cmath>

#include "hal/api/controller.h"

/// Drives ahead and turns left as long as its scanner tells of something near in front of it, for
/// benches and tests.
class Scanner : public hal::Controller {
 public:
  Scanner(hal::Robot& robot, const hal::Parameters& /*parameters*/) : robot_(robot) {}

  void step() override {
    const auto scan = robot_.scan();
    if (!scan) return;
    hal::Twist2 twist{.vx = 0.3};
    for (std::size_t i = 0; i < scan->ranges.size(); ++i)
      if (std::abs(scan->headings[i]) < 1.1 && scan->ranges[i] < 0.6) twist = {.omega = 1};
    (void)robot_.set_body_velocity(twist);
  }

 private:
  hal::Robot& robot_;
};

BARAKA_CONTROLLER {
  return {.name = "scanner",
          .wants = {.channels = {"scan"}},
          .make_for_robot = hal::make_for_robot<Scanner>};
}
