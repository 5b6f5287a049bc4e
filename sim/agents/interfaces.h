#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/agents/edge_lateness.h"
#include "sim/agents/observer.h"
#include "sim/agents/simulation_config.h"
#include "sim/air/frame_sink.h"
#include "sim/air/frame_source.h"
#include "sim/air/interface.h"
#include "sim/core/event_queue.h"
#include "sim/core/outside_input.h"
#include "sim/radio/radio_network.h"

namespace sim::agents {

/// The door by which the frames of an agent's programs come in.
inline std::string air_door(std::string_view agent) { return "air of " + std::string(agent); }

/// The interfaces of all agents that have a network. What comes in passes through OutsideInput, so
/// that it is recorded; what goes out goes to the sink, if there is one.
class Interfaces final : public air::InterfaceListener {
 public:
  /// What they belong to; outlives them.
  struct Home {
    EventQueue& events;
    OutsideInput& outside;
    Observer& observer;
  };
  Interfaces(const SimulationConfig& config, radio::RadioNetwork& radio, const Home& home);

  bool empty() const { return interfaces_.empty(); }

  /// Before the run.
  void connect(air::FrameSink& sink, air::FrameSource& source);
  /// Whether programs are there, and so frames from them.
  bool is_connected() const { return source_ != nullptr; }

  /// Readable while frames are there. @pre connected.
  int descriptor() const { return source_->descriptor(); }

  /// From now on the run follows this clock, which outlives it. If connected, that starts now: what
  /// the agents' kernels sent before, while their interfaces came up, enters then, and is not late.
  void follow(FollowedClock& clock);

  /// Takes what the programs have sent, each frame at the time that the clock shows.
  /// @param last  of the run: no frame comes in before. @pre connected, following a clock.
  void take_frames(hal::Time last);

  /// Tells the sink how many frames more each station's queue takes. @pre connected.
  void tell_room();

  AirSummary summary() const;

 private:
  struct AgentInterface {
    hal::AgentId agent;
    std::string door;
    std::unique_ptr<air::Interface> interface;
    std::size_t capacity = 0;  ///< Of the station's queue, frames.
    std::size_t held = 0;      ///< Frames that the run has not taken in yet.
  };

  void on_entered(hal::AgentId agent, const radio::MacRequest& request) override;
  void on_left(hal::AgentId agent, const radio::MacIndication& indication,
               std::span<const std::uint8_t> ethernet) override;
  void on_refused(hal::AgentId agent, air::Refusal refusal, std::size_t bytes) override;
  void on_ended(hal::AgentId) override {}
  void enter(hal::Time at, air::SentFrame&& frame);
  AgentInterface& of(hal::AgentId agent);

  Home home_;
  std::vector<AgentInterface> interfaces_;  ///< By address.
  air::FrameSink* sink_ = nullptr;
  air::FrameSource* source_ = nullptr;
  FollowedClock* clock_ = nullptr;
  EdgeLateness entering_, leaving_;
  std::array<std::uint64_t, air::kRefusals> refused_{};
};

}  // namespace sim::agents
