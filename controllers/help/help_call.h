#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/help_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// A mote's call for help, which is granted to the first robot that asks.
///
///              begin(): calls              asked: grants
///   IDLE ------------------> REQUEST ---------------------> WAIT ---------> FULFILLED
///                            |  ^  ^                       |    ^  owner arrived  |
///           nobody asked,    |  |  | owner gave up or      |    |                 |
///           repeats used up  |  |  | overdue: calls        +----+                 |
///                            v  |  +-----------------------+  owner asks again:   |
///                         GAVE_UP                             grants, waits anew  |
///                            |  |                                                 |
///                            +->+<------------------------------------------------+
///                                 begin(): calls anew
///
/// Any other robot that asks is refused. Repeated calls come early by a random share of the period:
/// otherwise two motes whose first calls collided would also lose all repeats. Time-outs are
/// checked once per control cycle. (Labella, Dietrich, Dressler, "Hybrid simulation of Sensor and
/// Actor Networks with BARAKA", 2009, section 6.2.)
class HelpCall {
 public:
  enum class State { kIdle, kRequest, kWait, kFulfilled, kGaveUp };
  /// The names under which the mote records its states, in the order of State.
  static constexpr std::array<std::string_view, 5> kStateNames{"IDLE", "REQUEST", "WAIT",
                                                               "FULFILLED", "GAVE_UP"};

  /// Parameters of the call. @param prefix  of their names, e.g. "help."; may be empty.
  static std::vector<hal::ParameterSpec> parameters(const std::string& prefix);
  HelpCall(hal::Mote& mote, const hal::Parameters& parameters, const std::string& prefix);

  void idle() { enter(State::kIdle); }
  void begin();  ///< @pre !is_on()
  void step();   ///< Call once per control cycle.
  void receive(const hal::Message& message);

  State state() const { return state_; }
  bool is_on() const { return state_ == State::kRequest || state_ == State::kWait; }

 private:
  void enter(State state);
  void broadcast();
  void repeat_or_give_up();
  void on_asked(hal::AgentId robot, hal::Duration max_hop);
  void say(hal::AgentId to, HelpWord word);

  hal::Mote& mote_;
  const hal::Duration repeat_after_;
  const double repeat_jitter_;
  const int max_repeats_;
  const hal::Duration max_hop_;

  State state_ = State::kIdle;
  int repeats_ = 0;
  hal::Time deadline_{};               ///< End of REQUEST or WAIT.
  std::optional<hal::AgentId> owner_;  ///< The robot in charge, in WAIT.
};

}  // namespace controllers
