#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "controllers/help/help_trip.h"
#include "hal/api/controller.h"

namespace controllers {
namespace {

/// A robot that goes to motes that call for help (HelpTrip), one after the other in random order.
class HelpRobot : public hal::Controller {
 public:
  HelpRobot(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), travel_(robot, parameters), trip_(robot, travel_, parameters, "") {}

  void start() override { trip_.idle(); }
  void stop() override { travel_.halt(); }

  void step() override {
    if (!trip_.is_on() && !calls_.empty()) return answer();
    trip_.step();
  }

  void receive(const hal::Message& message) override {
    const auto heard = message.topic == kHelpTopic ? decode(message.payload) : std::nullopt;
    if (!heard) return;
    if (heard->word == HelpWord::kHelp && !trip_.is_to(message.source)) {
      calls_.insert(message.source);
    }
    trip_.receive(message.source, heard->word);
  }

 private:
  void answer() {
    const auto choice = robot_.random().below(static_cast<std::uint32_t>(calls_.size()));
    const auto chosen = std::next(calls_.begin(), choice);
    const hal::AgentId mote = *chosen;
    calls_.erase(chosen);
    trip_.begin(mote);
  }

  hal::Robot& robot_;
  Travel travel_;
  HelpTrip trip_;
  std::set<hal::AgentId> calls_;  ///< Motes that called for help, except the destination.
};

std::vector<hal::ParameterSpec> parameters_of_help_robot() {
  std::vector<hal::ParameterSpec> all = Travel::parameters();
  for (hal::ParameterSpec& one : HelpTrip::parameters("")) all.push_back(std::move(one));
  return all;
}

}  // namespace
}  // namespace controllers

BARAKA_CONTROLLER {
  using controllers::HelpTrip;
  return {.name = "help_robot",
          .wants = {.channels = {"infrared", "localisation"},
                    .watched = {std::string(controllers::kHelpTopic)}},
          .parameters = controllers::parameters_of_help_robot(),
          .states = {HelpTrip::kStateNames.begin(), HelpTrip::kStateNames.end()},
          .make_for_robot = hal::make_for_robot<controllers::HelpRobot>};
}
