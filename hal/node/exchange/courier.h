#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/node/exchange/ports.h"

namespace hal::node::exchange {

/// Delivers the events of a host that does not wait for its controllers to one process: in
/// real-time runs, and on a robot. At most one Step is under way; events meanwhile wait in a
/// bounded queue and go into the next Step. One thread; only finish() and repeat() block.
///
///   courier.post(event); …
///   auto turn = courier.attend();      // after posts, and when a descriptor is readable
///   for (auto& answer : turn->answers) …
class Courier {
 public:
  /// Number of events that may wait. When the queue is full, new events are lost, except START and
  /// STOP. A process that drives many agents has room for kPerAgent events of each.
  static constexpr std::size_t kCapacity = 10'000;
  static constexpr std::size_t kPerAgent = 10;
  static constexpr std::size_t capacity_for(std::size_t agents) {
    return agents * kPerAgent > kCapacity ? agents * kPerAgent : kCapacity;
  }

  struct Answer {
    Action action;
    Time event_time{};  ///< Time of the event that the action answers.
  };
  /// The results of one call of attend(), repeat() or finish().
  struct Turn {
    bool replied = false;           ///< The Step under way was answered.
    Time until{};                   ///< Time of the last event in that Step.
    std::vector<Answer> answers;    ///< Its actions, in the order of the controllers' calls.
    std::vector<AgentId> answered;  ///< Agents with events in that Step, by address, once each.
    bool began = false;             ///< The next Step was handed over.
  };
  /// Whether commands in the answer are out of date: a command must not be based on events older
  /// than the command timeout. A process that was halted (by a debugger, SIGSTOP, swapping) first
  /// answers the Step from before the halt.
  static bool is_stale(const Turn& turn, Time now, Duration command_timeout) {
    return turn.replied && now - turn.until > command_timeout;
  }
  /// Reason given when such a command is refused.
  static constexpr const char* kStale = "drive: it answers what is older than the command timeout";

  /// Events that the controller will not receive.
  struct Losses {
    /// Control cycles that passed while the process was busy; the next cycle replaced them and
    /// carries their readings.
    std::uint64_t missed_cycles = 0;
    /// Events that were lost because the queue was full, by agent and cause.
    std::map<std::pair<AgentId, Cause>, std::uint64_t> overflow;
  };

  explicit Courier(std::shared_ptr<ControllerPort> port, std::size_t capacity = kCapacity);

  const std::string& name() const { return port_->name(); }

  /// Adds an event to the queue. Changes of readings, routes and neighbours in a lost or superseded
  /// event are carried over to the next event of that agent.
  void post(Event event);

  /// Takes the answer if it has arrived, then hands over the waiting events if the process is idle.
  /// Errors: kNotConnected (the process died).
  Result<Turn> attend();

  /// The same with a given outcome, to repeat a recorded run: waits for the answer if `replied`,
  /// begins a Step if `began`. Errors: those of ControllerPort; kProtocol if the record does not
  /// fit because no Step is under way or no event waits.
  Result<Turn> repeat(bool replied, bool began);

  /// Waits for the answer to the Step under way, if there is one. Errors: those of ControllerPort.
  Result<Turn> finish();

  bool is_idle() const { return !under_way_; }  ///< No Step is under way.
  bool has_waiting() const { return !waiting_.empty(); }
  std::uint64_t steps() const { return sequence_; }  ///< Number of Steps handed over.
  const Losses& losses() const { return losses_; }

  /// For poll(): readable when attend() may have a result.
  std::vector<int> descriptors() const { return port_->descriptors(); }

 private:
  void take_in(Reply reply, Turn& turn);
  Result<void> begin(Turn& turn);
  void lose(Event event);
  void supersede_cycle(const Event& control);

  std::shared_ptr<ControllerPort> port_;
  std::size_t capacity_;
  using Waiting = std::list<Event>;
  Waiting waiting_;
  std::map<AgentId, std::vector<Waiting::iterator>> places_;  ///< Events in waiting_.
  std::map<AgentId, Event> carried_;  ///< Changes to add to the next event of their agent.
  Step step_;                         ///< Under way, or the last one.
  bool under_way_ = false;
  std::uint64_t sequence_ = 0;
  Losses losses_;
};

/// Adds the changes in `earlier` to `later`, as if `later` had brought them.
void absorb(Event earlier, Event& later);

}  // namespace hal::node::exchange
