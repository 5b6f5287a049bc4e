#include <limits>
#include <utility>
#include <vector>

#include "controllers/help/help_call.h"
#include "controllers/help/recurrence.h"
#include "hal/api/controller.h"

namespace controllers {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A mote that calls for help at given times (HelpCall). A call that falls due during another one
/// is skipped.
class HelpMote : public hal::Controller {
 public:
  HelpMote(hal::Mote& mote, const hal::Parameters& parameters)
      : mote_(mote),
        due_(parameters["help_at"], parameters["help_every"]),
        call_(mote, parameters, "") {}

  void start() override { call_.idle(); }

  void step() override {
    if (due_.falls_due(mote_.now()) && !call_.is_on()) call_.begin();
    call_.step();
  }

  void receive(const hal::Message& message) override { call_.receive(message); }

 private:
  hal::Mote& mote_;
  Recurrence due_;
  HelpCall call_;
};

std::vector<hal::ParameterSpec> parameters_of_help_mote() {
  std::vector<hal::ParameterSpec> all = {
      {"help_at", "s", kNever, 0, kNever, "When it calls for help."},
      {"help_every", "s", kNever, 1, kNever,
       "Time from one call to the next one that is about something new."}};
  for (hal::ParameterSpec& one : HelpCall::parameters("")) all.push_back(std::move(one));
  return all;
}

}  // namespace
}  // namespace controllers

BARAKA_CONTROLLER {
  using controllers::HelpCall;
  return {.name = "help_mote",
          .parameters = controllers::parameters_of_help_mote(),
          .states = {HelpCall::kStateNames.begin(), HelpCall::kStateNames.end()},
          .make_for_mote = hal::make_for_mote<controllers::HelpMote>};
}
