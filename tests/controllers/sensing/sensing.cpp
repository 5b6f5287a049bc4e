#include <string>

#include "hal/api/controller.h"

/// Drives ahead whatever it sees, and states which of the channels it has, for the end-to-end
/// tests.
class Sensing : public hal::Controller {
 public:
  Sensing(hal::Robot& robot, const hal::Parameters&) : robot_(robot) {}

  void step() override {
    (void)robot_.set_body_velocity({.vx = 0.1});
    std::string has = "has";
    if (robot_.odometry()) has += " odometry";
    if (robot_.infrared()) has += " infrared";
    if (robot_.reading("localisation")) has += " localisation";
    if (has == has_) return;
    has_ = has;
    robot_.state(has_);
  }

 private:
  hal::Robot& robot_;
  std::string has_;
};

BARAKA_CONTROLLER {
  return {.name = "sensing",
          .wants = {.channels = {"odometry", "infrared", "localisation"}},
          .make_for_robot = hal::make_for_robot<Sensing>};
}
