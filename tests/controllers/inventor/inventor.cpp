#include <fmt/format.h>

#include "hal/api/controller.h"

/// Invents as many topics in each control cycle as its parameter says, for the end-to-end tests. It
/// says in its state how many it was granted.
class Inventor : public hal::Controller {
 public:
  Inventor(hal::Mote& mote, const hal::Parameters& parameters)
      : mote_(mote), topics_(static_cast<int>(parameters["topics"])) {}

  void step() override {
    for (int i = 0; i < topics_; ++i) {
      const auto sent = mote_.send(hal::AgentId{2}, fmt::format("topic {}", invented_++), {});
      if (sent) {
        ++granted_;
      } else {
        refusal_ = sent.error().message;
      }
    }
  }

  void stop() override {
    mote_.state(fmt::format("granted {} of {}", granted_, invented_));
    mote_.log(hal::log::Level::kInfo, refusal_);
  }

 private:
  hal::Mote& mote_;
  const int topics_;  // per control cycle
  int invented_ = 0;
  int granted_ = 0;
  std::string refusal_;
};

BARAKA_CONTROLLER {
  return {.name = "inventor",
          .parameters = {{"topics", "1", 0, 0, 1e6, "Topics invented in each control cycle."}},
          .make_for_mote = hal::make_for_mote<Inventor>};
}
