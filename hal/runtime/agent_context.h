#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/api/controller.h"
#include "hal/exchange/directory.h"
#include "hal/exchange/session.h"
#include "hal/runtime/call_guard.h"
#include "hal/runtime/mistakes.h"
#include "hal/runtime/outbox.h"
#include "hal/runtime/readings.h"
#include "hal/runtime/route_view.h"
#include "hal/types/random.h"
#include "hal/types/result.h"
#include "hal/types/time.h"
#include "hal/types/used_names.h"

namespace hal::runtime {

/// What one agent knows and keeps between events: all that its Mote or Robot answers from.
struct AgentContext {
  /// @param names  outlives the context.
  AgentContext(const exchange::AgentSession& agent_session, const ControllerKind& kind, Outbox& out,
               const exchange::Directory& names);

  /// Updates the knowledge from what an event brings. What is against the rules is logged and left.
  void take_in(const exchange::Event& event);

  /// Logs that a call was refused, naming the agent and what was wrong, as far as Mistakes lets it,
  /// and gives the same as an error to the caller.
  tl::unexpected<Error> refuse(std::string_view call, std::string_view mistake);

  /// Whether the last action in the outbox keeps the rules of exchange::validate(). If not it is
  /// taken back and refused.
  Result<void> judge_last();

  /// Whether the controller asked who is who; if not, the call is refused.
  bool has_names(std::string_view call);

  /// Logs how often mistakes were made that refuse() did not log. To be called in the end.
  void log_mistakes();

  /// What the controller itself says; what it just says again of an error that refuse() gave it is
  /// in the log already.
  void log_of_controller(log::Level level, std::string_view text);

  /// A log line of this agent's controller process.
  void log(log::Level level, std::string text);

  /// A timer may have been moved while its old event was under way: whether it is really due. If
  /// so, it is no longer set.
  bool take_due_timer(TimerId id);

  const exchange::AgentSession session;
  const std::vector<std::string> states;   ///< That the controller declares; empty: it does not.
  const std::vector<std::string> records;  ///< Names of values, likewise.
  CallGuard guard;
  Outbox& outbox;
  Time now{};
  Readings readings;
  RouteView routes;
  RandomStream random;
  MessageId last_message = 0;
  const exchange::Directory& directory;  ///< Empty unless asked for.
  const bool asked_for_names;
  Topics topics;
  RecordedNames recorded;
  Mistakes mistakes;
  std::string last_refusal;  ///< As the controller was told.
  std::map<TimerId, Time> timers;
};

}  // namespace hal::runtime
