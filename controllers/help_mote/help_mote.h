#pragma once

#include <optional>

#include "controllers/help_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// A mote that calls for help at given times and hands the task to the first robot that asks.
///
///            help_at, calls                asked: grants
///   IDLE ------------------> REQUEST ---------------------> WAIT ---------> FULFILLED
///                            |  ^  ^                       |    ^  owner arrived  |
///           nobody asked,    |  |  | owner gave up or      |    |                 |
///           repeats used up  |  |  | overdue: calls        +----+                 |
///                            v  |  +-----------------------+  owner asks again:   |
///                         GAVE_UP                             grants, waits anew  |
///                            |  |                                                 |
///                            +->+<------------------------------------------------+
///                                 help_every after the last due call: calls
///
/// Whoever asks in any other case is refused. A call that falls due while another is on is left
/// out. Repeated calls come a random share of their time early: two motes that called in the same
/// instant, and lost their calls to each other, would lose every repeat. Times are looked at once
/// per control cycle. (Labella, Dietrich, Dressler, "Hybrid simulation of Sensor and Actor Networks
/// with BARAKA", 2009, section 6.2.)
class HelpMote : public hal::Controller {
 public:
  HelpMote(hal::Mote& mote, const hal::Parameters& parameters);

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;

 private:
  enum class State { kIdle, kRequest, kWait, kFulfilled, kGaveUp };

  void enter(State state);
  bool is_calling() const { return state_ == State::kRequest || state_ == State::kWait; }
  bool falls_due();
  void call_for_help();
  void broadcast_call();
  void repeat_or_give_up();
  void on_asked(hal::AgentId robot, hal::Duration max_hop);
  void say(hal::AgentId to, HelpWord word);

  hal::Mote& mote_;
  std::optional<hal::Time> help_at_;               ///< Next call; nothing: none any more.
  const std::optional<hal::Duration> help_every_;  ///< Nothing: one call is all.
  const hal::Duration repeat_after_;
  const double repeat_jitter_;
  const int max_repeats_;
  const hal::Duration max_hop_;

  State state_ = State::kIdle;
  int repeats_ = 0;
  hal::Time deadline_{};               ///< Of REQUEST and WAIT.
  std::optional<hal::AgentId> owner_;  ///< The robot in charge: in WAIT.
};

}  // namespace controllers
