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

/// Carries the events of a host that does not wait for its controllers, to one process: in real
/// time, and on a robot. At most one Step is under way; what happens meanwhile waits, bounded, and
/// goes into the next Step. One thread; nothing here blocks but finish().
///
///   courier.post(event); …
///   auto turn = courier.attend();      // after posts, and when a descriptor is readable
///   for (auto& answer : turn->answers) …
class Courier {
 public:
  /// Events that may wait. Beyond it new ones are lost, except START and STOP. A process that
  /// drives many agents gets room for kPerAgent of each.
  static constexpr std::size_t kCapacity = 10'000;
  static constexpr std::size_t kPerAgent = 10;
  static constexpr std::size_t capacity_for(std::size_t agents) {
    return agents * kPerAgent > kCapacity ? agents * kPerAgent : kCapacity;
  }

  struct Answer {
    Action action;
    Time event_time{};  ///< Of the event that the action answers.
  };
  /// What one look at the port brought.
  struct Turn {
    bool replied = false;           ///< The Step under way was answered …
    Time until{};                   ///< … which tells of nothing after this, its last event …
    std::vector<Answer> answers;    ///< … with these, in the order of the controllers' calls …
    std::vector<AgentId> answered;  ///< … and it held events of these agents (by address, once).
    bool began = false;             ///< The next Step was handed over.
  };
  /// Whether what the answers command is out of date: nobody may drive by what was seen longer ago
  /// than the command timeout. A process that was halted (by a debugger, SIGSTOP, swapping) answers
  /// first what it was asked before.
  static bool is_stale(const Turn& turn, Time now, Duration command_timeout) {
    return turn.replied && now - turn.until > command_timeout;
  }
  /// What is said of such a command.
  static constexpr const char* kStale = "drive: it answers what is older than the command timeout";

  /// Events that no controller will see.
  struct Losses {
    /// Control cycles that passed while the process was busy: the next one took their place, with
    /// their readings.
    std::uint64_t missed_cycles = 0;
    /// Events that found no room, by agent and cause: overflow.
    std::map<std::pair<AgentId, Cause>, std::uint64_t> overflow;
  };

  explicit Courier(std::shared_ptr<ControllerPort> port, std::size_t capacity = kCapacity);

  const std::string& name() const { return port_->name(); }

  /// Adds an event to those that wait. Changes of readings, routes and neighbours that a lost or
  /// superseded event carries go into the next event of that agent.
  void post(Event event);

  /// Takes the answer if it is there, and hands over what waits if the process is idle then.
  /// Errors: kNotConnected (the process died).
  Result<Turn> attend();

  /// The same with a given outcome, for the repetition of a recorded run: waits for the answer if
  /// `replied`, begins a Step if `began`. Errors: those of ControllerPort, and kProtocol if the
  /// record does not fit: nothing is under way, or nothing waits.
  Result<Turn> repeat(bool replied, bool began);

  /// Waits for the answer to the Step under way, if one is. Errors: those of ControllerPort.
  Result<Turn> finish();

  bool is_idle() const { return !under_way_; }  ///< No Step is under way.
  bool has_waiting() const { return !waiting_.empty(); }
  std::uint64_t steps() const { return sequence_; }  ///< Handed over.
  const Losses& losses() const { return losses_; }

  /// For poll(): readable when attend() may bring something.
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
  std::map<AgentId, std::vector<Waiting::iterator>> places_;  ///< Of an agent's events in it.
  std::map<AgentId, Event> carried_;  ///< Changes that await an event of their agent.
  Step step_;                         ///< Under way, or the last one.
  bool under_way_ = false;
  std::uint64_t sequence_ = 0;
  Losses losses_;
};

/// Adds the changes that `earlier` carries to `later`, as if they had come with it.
void absorb(Event earlier, Event& later);

}  // namespace hal::node::exchange
