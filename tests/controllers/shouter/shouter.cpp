#include <string>

#include "hal/api/controller.h"

/// Broadcasts by a timer that it sets in start(), for the end-to-end tests.
class Shouter : public hal::Controller {
 public:
  Shouter(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), every_(hal::from_seconds(parameters["every"])) {}

  void start() override {
    robot_.state("STARTED");
    (void)robot_.set_timer(1, robot_.now() + every_);
  }

  void timer(hal::TimerId id) override {
    [[maybe_unused]] const auto sent = robot_.send(hal::kEveryone, "ping", {});
    (void)robot_.set_timer(id, robot_.now() + every_);
  }

  void notice(hal::MessageId, hal::Fate fate) override {
    if (fate == hal::Fate::kHandedOver) ++handed_over_;
  }

  void stop() override { robot_.state("HANDED_OVER " + std::to_string(handed_over_)); }

 private:
  hal::Robot& robot_;
  const hal::Duration every_;
  int handed_over_ = 0;
};

BARAKA_CONTROLLER {
  return {.name = "shouter",
          .wants = {},
          .parameters = {{"every", "s", 0.1, 0.001, 60, "Time between two broadcasts."}},
          .make_for_robot = hal::make_for_robot<Shouter>};
}
