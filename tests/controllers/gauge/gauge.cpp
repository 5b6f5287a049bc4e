#include <fmt/core.h>

#include "hal/api/controller.h"

/// Says in its state what its battery tells after some time, for the end-to-end tests; a robot
/// drives ahead meanwhile.
class Gauge : public hal::Controller {
 public:
  Gauge(hal::Mote& mote, const hal::Parameters& parameters)
      : thing_(mote), parameters_(parameters) {}
  Gauge(hal::Robot& robot, const hal::Parameters& parameters)
      : thing_(robot), robot_(&robot), parameters_(parameters) {}

  void start() override {
    if (robot_ != nullptr) (void)robot_->set_body_velocity({parameters_["speed"]});
  }

  void step() override {
    if (is_told_ || hal::to_seconds(thing_.now()) < parameters_["after"]) return;
    is_told_ = true;
    const auto charge = thing_.battery();
    const auto reading = thing_.reading("battery");
    const auto energy = thing_.battery_energy(), capacity = thing_.battery_capacity();
    if (!charge || !reading || !energy || !capacity) return thing_.state("no battery");
    thing_.state(fmt::format("{:.9f} {:.6f} {:.6f} {:.6f} {:.6f}", *charge, (*reading)[1],
                             (*reading)[2], *energy, *capacity));
  }

 private:
  hal::RealWorldObject& thing_;
  hal::Robot* robot_ = nullptr;
  const hal::Parameters parameters_;
  bool is_told_ = false;
};

BARAKA_CONTROLLER {
  return {.name = "gauge",
          .wants = {.channels = {}, .optional = {"battery"}},
          .parameters = {{"speed", "m/s", 0.2, 0, 10, "Of a robot, ahead."},
                         {"after", "s", 10, 0, 1e6, "When it says what the battery tells."}},
          .make_for_mote = hal::make_for_mote<Gauge>,
          .make_for_robot = hal::make_for_robot<Gauge>};
}
