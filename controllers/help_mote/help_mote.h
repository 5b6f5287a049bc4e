#pragma once

#include <optional>

#include "controllers/help_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// A mote that calls for help at a given time and hands the task to the first robot that asks.
///
///            help_at, calls                asked: grants
///   IDLE ------------------> REQUEST ---------------------> WAIT ---------> FULFILLED
///                             |    ^                       |    ^  owner arrived
///           nobody asked,     |    | owner gave up or      |    |
///           repeats used up   |    | overdue: calls        +----+
///                             v    +-----------------------+  owner asks again: grants,
///                          GAVE_UP                            waits anew
///
/// Whoever asks in any other case is refused. Times are looked at once per control cycle.
/// (Labella, Dietrich, Dressler, "Hybrid simulation of Sensor and Actor Networks with BARAKA",
/// 2009, section 6.2.)
class HelpMote : public hal::Controller {
 public:
  HelpMote(hal::Mote& mote, const hal::Parameters& parameters);

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;

 private:
  enum class State { kIdle, kRequest, kWait, kFulfilled, kGaveUp };

  void enter(State state);
  void call_for_help();
  void repeat_or_give_up();
  void on_asked(hal::AgentId robot, hal::Duration max_hop);
  void say(hal::AgentId to, HelpWord word);

  hal::Mote& mote_;
  const std::optional<hal::Time> help_at_;  ///< Nothing: never.
  const hal::Duration repeat_after_;
  const int max_repeats_;
  const hal::Duration max_hop_;

  State state_ = State::kIdle;
  int repeats_ = 0;
  hal::Time deadline_{};               ///< Of REQUEST and WAIT.
  std::optional<hal::AgentId> owner_;  ///< The robot in charge: in WAIT.
};

}  // namespace controllers
