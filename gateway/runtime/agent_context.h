#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/runtime/call_guard.h"
#include "gateway/runtime/mistakes.h"
#include "gateway/runtime/outbox.h"
#include "gateway/runtime/readings.h"
#include "gateway/runtime/route_view.h"
#include "hal/api/controller.h"
#include "hal/node/exchange/directory.h"
#include "hal/node/exchange/session.h"
#include "hal/types/random.h"
#include "hal/types/result.h"
#include "hal/types/time.h"
#include "hal/types/used_names.h"

namespace gateway::runtime {

/// State of one agent between events, from which its Mote or Robot answers calls.
struct AgentContext {
  /// @param names  outlives the context.
  AgentContext(const hal::node::exchange::AgentSession& agent_session,
               const hal::ControllerKind& kind, Outbox& out,
               const hal::node::exchange::Directory& names);

  /// Updates the state from an event. Values that violate the protocol are logged and ignored.
  void take_in(const hal::node::exchange::Event& event);

  /// Logs that a call was refused, with the agent and the reason, as far as Mistakes permits, and
  /// returns the same as an error to the caller.
  tl::unexpected<hal::Error> refuse(std::string_view call, std::string_view mistake);

  /// Whether the last action in the outbox obeys the rules of exchange::validate(). If not, it is
  /// removed and refused.
  hal::Result<void> judge_last();

  /// Whether the controller asked for names of agents; if not, the call is refused.
  bool has_names(std::string_view call);

  /// Logs how often mistakes were made that refuse() did not log. Call it at the end.
  void log_mistakes();

  /// Logs a line of the controller itself. If the line just repeats the error that refuse()
  /// returned to it, it is dropped, because that is in the log already.
  void log_of_controller(hal::log::Level level, std::string_view text);

  /// A log line of this agent's controller process.
  void log(hal::log::Level level, std::string text);

  /// Whether a timer is really due: it may have been moved while its old event was on its way. If
  /// it is due, it is no longer set.
  bool take_due_timer(hal::TimerId id);

  const hal::node::exchange::AgentSession session;
  const std::vector<std::string> states;   ///< Declared by the controller; empty: it declares none.
  const std::vector<std::string> records;  ///< Names of values, declared likewise.
  CallGuard guard;
  Outbox& outbox;
  hal::Time now{};
  Readings readings;
  RouteView routes;
  hal::RandomStream random;
  hal::MessageId last_message = 0;
  const hal::node::exchange::Directory& directory;  ///< Empty unless asked for.
  const bool asked_for_names;
  hal::Topics topics;
  hal::RecordedNames recorded;
  Mistakes mistakes;
  std::string last_refusal;  ///< The error as returned to the controller.
  std::map<hal::TimerId, hal::Time> timers;
};

}  // namespace gateway::runtime
