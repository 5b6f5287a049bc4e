#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/api/controller.h"

/// Drives ahead until it bumps and then backs off, for the end-to-end tests; says in its state what
/// its sensors told there.
class Surveyor : public hal::Controller {
 public:
  Surveyor(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), parameters_(parameters) {}

  void start() override { drive(parameters_["speed"]); }

  void step() override {
    const auto bumped = robot_.bumped();
    if (backing_ || !bumped || !*bumped) return;
    backing_ = true;
    drive(-parameters_["speed"]);
    robot_.state("bumped " + told());
  }

 private:
  void drive(double speed) { [[maybe_unused]] const auto done = robot_.set_body_velocity({speed}); }

  /// Nearest range within 0.5 rad of straight ahead, x of the pose, and the upward force.
  std::string told() const {
    const auto scan = robot_.scan();
    const auto pose = robot_.pose();
    const auto imu = robot_.imu();
    if (!scan || !pose || !imu) return "blind";
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scan->ranges.size(); ++i) {
      if (std::abs(scan->headings[i]) > 0.5 || std::isnan(scan->ranges[i])) continue;
      nearest = std::min(nearest, scan->ranges[i]);
    }
    return fmt::format("{:.3f} {:.3f} {:.3f}", nearest, pose->x, imu->specific_force.z);
  }

  hal::Robot& robot_;
  const hal::Parameters parameters_;
  bool backing_ = false;
};

BARAKA_CONTROLLER {
  return {.name = "surveyor",
          .wants = {{"scan", "pose", "imu", "bumper"}},
          .parameters = {{"speed", "m/s", 0.2, 0.01, 10, "Ahead, and back."}},
          .make_for_robot = hal::make_for_robot<Surveyor>};
}
