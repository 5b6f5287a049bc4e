#include "hal/api/controller.h"

/// A robot's controller that can do without its infrared sensors, for the end-to-end tests. It says
/// in its state whether it has them, and, if it is told to, a state that it does not declare.
class Blind : public hal::Controller {
 public:
  Blind(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), lies_(parameters["lies"] > 0) {}

  void step() override {
    const auto infrared = robot_.infrared();
    if (!infrared) robot_.log(hal::log::Level::kInfo, infrared.error().message);
    robot_.state(infrared ? "SEES" : "BLIND");
    if (lies_) robot_.state("DREAMS");
  }

 private:
  hal::Robot& robot_;
  const bool lies_;
};

BARAKA_CONTROLLER {
  return {.name = "blind",
          .wants = {.channels = {"odometry"}, .optional = {"infrared"}},
          .parameters = {{"lies", "1", 0, 0, 1, "Whether it enters a state it does not declare."}},
          .states = {"SEES", "BLIND"},
          .make_for_robot = hal::make_for_robot<Blind>};
}
