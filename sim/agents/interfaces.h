#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/agents/air_door.h"
#include "sim/agents/edge_lateness.h"
#include "sim/agents/observer.h"
#include "sim/agents/simulation_config.h"
#include "sim/air/frame_sink.h"
#include "sim/air/frame_source.h"
#include "sim/air/held_programs.h"
#include "sim/air/interface.h"
#include "sim/core/event_queue.h"
#include "sim/core/outside_input.h"
#include "sim/radio/radio_network.h"

namespace sim::agents {

/// The interfaces of all agents that have a network. Frames from programs pass through
/// OutsideInput, so that they are recorded; received frames go to the sink, if there is one.
class Interfaces final : public air::InterfaceListener {
 public:
  /// The parts of the simulation that are used here; they outlive the interfaces.
  struct Home {
    EventQueue& events;
    OutsideInput& outside;
    Observer& observer;
    std::function<void()> break_off;  ///< Ends the run early: a program was interrupted.
  };
  Interfaces(const SimulationConfig& config, radio::RadioNetwork& radio, const Home& home);

  bool empty() const { return interfaces_.empty(); }

  /// Connects the programs. Call before the run.
  void connect(air::FrameSink& sink, air::FrameSource& source);
  /// The same in lock-step.
  void connect(air::FrameSink& sink, air::HeldPrograms& programs);

  bool holds_programs() const { return programs_ != nullptr; }

  /// In lock-step: lets the programs of all agents begin. @pre the clock shows the start.
  void start_programs();
  /// In lock-step, between two instants: gives a turn at `next` to agents whose programs somebody
  /// outside the run has started or made go on.
  void serve_outsiders(hal::Time next);
  /// In lock-step, while the run waits: gives turns to agents of which something comes by the wall
  /// clock.
  void serve_due();
  /// In lock-step: something comes from programs at this instant.
  void arrive(const std::string& door, std::span<const std::uint8_t> bytes);
  /// In a repetition of a run in lock-step: what came from its programs, in this order.
  void repeat_arrivals(std::vector<OutsideArrival> arrivals);
  /// In such a repetition: a controller's answer, which is one of them, has come.
  void note_repeated(const std::string& door);
  /// Whether programs are connected, so that frames may come from them.
  bool is_connected() const { return source_ != nullptr; }

  /// File descriptor that is readable while frames are available. @pre connected.
  int descriptor() const { return source_->descriptor(); }

  /// Makes the run follow this clock, which outlives the interfaces. If connected, the clock starts
  /// now: frames that the agents' kernels sent earlier, while their interfaces came up, enter now
  /// and do not count as late.
  void follow(FollowedClock& clock);

  /// Takes the frames that programs have sent, each at the time that the clock shows.
  /// @param last  end of the part of the run already simulated: all frames enter after it. @pre
  /// connected, and following a clock.
  void take_frames(hal::Time last);

  /// Reports to the sink how many more frames each station's queue accepts. @pre connected.
  void tell_room();

  AirSummary summary() const;

 private:
  struct AgentInterface {
    hal::AgentId agent;
    std::string door;
    std::unique_ptr<air::Interface> interface;
    std::size_t capacity = 0;    ///< Size of the station's queue, in frames.
    std::size_t held = 0;        ///< Frames read that have not entered the run yet.
    EventQueue::EventId turn{};  ///< In lock-step: when its programs go on next.
    hal::Time turn_at{};
  };

  void on_entered(hal::AgentId agent, const radio::MacRequest& request) override;
  void on_left(hal::AgentId agent, const radio::MacIndication& indication,
               std::span<const std::uint8_t> ethernet) override;
  void on_refused(hal::AgentId agent, air::Refusal refusal, std::size_t bytes) override;
  void on_ended(hal::AgentId agent) override;
  void enter(hal::Time at, air::SentFrame&& frame);
  AgentInterface& of(hal::AgentId agent);
  void tell_room(const AgentInterface& one);
  void schedule_start();
  void start_due();
  void set_turn(AgentInterface& one, hal::Time at);
  void take_turn(std::size_t i);
  void schedule_repeated();

  Home home_;
  std::vector<AgentInterface> interfaces_;  ///< By address.
  air::FrameSink* sink_ = nullptr;
  air::FrameSource* source_ = nullptr;
  air::HeldPrograms* programs_ = nullptr;  ///< In lock-step.
  std::deque<OutsideArrival> repeated_;
  FollowedClock* clock_ = nullptr;
  EdgeLateness entering_, leaving_;
  std::array<std::uint64_t, air::kRefusals> refused_{};
};

}  // namespace sim::agents
