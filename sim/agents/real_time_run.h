#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "hal/node/exchange/courier.h"
#include "sim/agents/lateness.h"
#include "sim/agents/simulation_state.h"

namespace sim::agents {

/// The loop of a run whose simulated time follows a clock. Events run when the clock shows their
/// time; a Courier per process carries events to controllers, and a reply takes effect when it
/// arrives. The controller latency of the scenario is not used: the real latency applies.
class Simulation::RealTimeRun {
 public:
  explicit RealTimeRun(State& state);

  /// Runs until an end condition holds, state.until is reached or the run is interrupted. Every
  /// turn is reported to the observers.
  void follow(FollowedClock& clock);

  /// The same with the turns of a recorded run instead of a clock, as fast as `pace` permits.
  void repeat(std::span<const Turn> turns, Pace& pace);

  /// As in Simulation::repeat().
  void set_open_loop(bool open_loop) { open_loop_ = open_loop; }

  /// Waits for pending replies, tells every controller to stop, and waits again.
  void stop();

  std::uint64_t steps() const;
  RealTimeSummary summary() const;

 private:
  struct Carried {
    hal::node::exchange::Courier courier;
    bool dropped = false;
  };

  void work_off_until(hal::Time target, FollowedClock* clock);
  void repeat_rest(Pace& pace);
  void take_arrivals_until(hal::Time target, FollowedClock* clock);
  void take_arrivals_at(hal::Time at);
  void take_last_arrivals(hal::Time turn, FollowedClock& clock);
  std::optional<hal::Time> next_stop(hal::Time last);
  hal::Duration longest_turn() const;
  void post(FollowedClock* clock);
  void attend(hal::Time now);
  void take_up(const Turn& turn);
  void take_in(const Turn& turn, const hal::node::exchange::Courier::Turn& brought);
  void take_effect(const hal::node::exchange::Courier::Answer& answer, bool stale);
  void on_death(const Turn& turn, const hal::Error& error);
  bool may_go_on(Pace& pace, hal::Time at);
  void finish_all();
  void restart_watchdog(hal::AgentId agent);
  std::vector<int> descriptors() const;
  Progress progress() const;

  State& s_;
  std::vector<Carried> carried_;                           ///< By port.
  std::map<hal::AgentId, EventQueue::EventId> watchdogs_;  ///< One per robot.
  Lateness lateness_;                                      ///< Lateness of control instants.
  RealTimeSummary counts_;
  bool open_loop_ = false;
};

}  // namespace sim::agents
