#include <fmt/core.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <thread>

#include "hal/api/controller.h"

/// Counts what it is sent, and is slow, for the end-to-end tests. Sends a number per control cycle.
class Tally : public hal::Controller {
 public:
  Tally(hal::Mote& mote, const hal::Parameters& parameters)
      : mote_(mote), parameters_(parameters) {}

  void step() override {
    if (parameters_["sleep"] > 0) {
      std::this_thread::sleep_for(hal::from_seconds(parameters_["sleep"]));
    }
    if (parameters_["send_to"] < 1) return;
    ++sent_;
    std::array<std::uint8_t, sizeof(sent_)> bytes{};
    std::memcpy(bytes.data(), &sent_, sizeof(sent_));
    const hal::AgentId to{static_cast<std::uint16_t>(parameters_["send_to"])};
    [[maybe_unused]] const auto id = mote_.send(to, "tally", bytes);
  }

  void receive(const hal::Message& message) override {
    std::uint64_t number = 0;
    std::memcpy(&number, message.payload.data(), sizeof(number));
    disordered_ += number <= last_ ? 1 : 0;
    last_ = number;
    ++received_;
  }

  void stop() override {
    mote_.state(fmt::format("sent {} received {} disordered {}", sent_, received_, disordered_));
  }

 private:
  hal::Mote& mote_;
  const hal::Parameters parameters_;
  std::uint64_t sent_ = 0, received_ = 0, disordered_ = 0, last_ = 0;
};

BARAKA_CONTROLLER {
  return {.name = "tally",
          .wants = {},
          .parameters = {{"send_to", "1", 0, 0, 65535, "Address of the receiver; 0: nobody."},
                         {"sleep", "s", 0, 0, 10, "How long a control cycle takes."}},
          .make_for_mote = hal::make_for_mote<Tally>};
}
