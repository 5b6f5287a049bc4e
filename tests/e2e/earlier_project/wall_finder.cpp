#include <hal/api/controller.h>
#include <hal/types/math.h>

/// Drives ahead until something is near in front of it, and stays there.
class WallFinder : public hal::Controller {
 public:
  WallFinder(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), speed_(parameters["speed"]), stop_at_(parameters["stop_at"]) {}

  void start() override { robot_.state("DRIVING"); }  // the scenario can wait for states

  void step() override {  // once per control cycle
    const auto infrared = robot_.infrared();
    if (arrived_ || !infrared) return;  // no reading yet: the first sample takes a moment
    double nearest = kFar;
    for (const auto& [heading, range] : *infrared) {  // range: NaN if nothing is within reach
      if (hal::math::cos(heading) > 0.9 && range < nearest) nearest = range;
    }
    arrived_ = nearest < stop_at_;
    robot_.record("nearest", nearest);  // into the results, and what the scenario may observe
    // Drives until the next command. What is beyond the motors is scaled, and the result says so.
    const auto drive = robot_.set_body_velocity({.vx = arrived_ ? 0 : speed_});
    if (!drive) robot_.log(hal::log::Level::kWarning, drive.error().message);
    if (arrived_) robot_.state("ARRIVED");
  }

 private:
  static constexpr double kFar = 1;  // m, nothing is seen from there

  hal::Robot& robot_;
  const double speed_;    // m/s
  const double stop_at_;  // m
  bool arrived_ = false;
};

BARAKA_CONTROLLER {
  return {.name = "wall_finder",
          .wants = {.channels = {"infrared"}},
          .parameters = {{"speed", "m/s", 0.3, 0, 1, "Speed ahead."},
                         {"stop_at", "m", 0.3, 0.1, 0.8, "Distance to stop at."}},
          .states = {"DRIVING", "ARRIVED"},
          .records = {{"nearest", "m", "Distance of what is nearest ahead; 1 m: nothing is seen."}},
          .make_for_robot = hal::make_for_robot<WallFinder>};
}
