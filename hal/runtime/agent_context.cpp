#include "hal/runtime/agent_context.h"

#include <fmt/core.h>

namespace hal::runtime {

AgentContext::AgentContext(const exchange::AgentSession& agent_session, const ControllerKind& kind,
                           Outbox& out)
    : session(agent_session),
      states(kind.states),
      outbox(out),
      readings(agent_session.channels),
      routes(kind.wants.watched, kind.wants.neighbours),
      random(agent_session.seed, agent_session.name + "/controller") {}

void AgentContext::take_in(const exchange::Event& event) {
  now = event.time;
  for (const exchange::Reading& reading : event.readings) {
    const Result<void> held = readings.hold(reading);
    if (!held) log(log::Level::kError, fmt::format("{}: {}", session.name, held.error().message));
  }
  routes.take_in(event);
}

tl::unexpected<Error> AgentContext::refuse(const char* call, std::string_view mistake) {
  const std::string text = fmt::format("{}: {}: {}", session.name, call, mistake);
  log(log::Level::kWarning, text);
  return fail(Errc::kInvalidArgument, text);
}

tl::unexpected<Error> AgentContext::refuse_once(const char* call, std::string_view mistake) {
  if (refused_calls.insert(call).second) return refuse(call, mistake);
  return fail(Errc::kInvalidArgument, fmt::format("{}: {}: {}", session.name, call, mistake));
}

void AgentContext::log(log::Level level, std::string text) {
  exchange::Action& action = outbox.add(exchange::ActionKind::kLog);
  action.level = level;
  action.text = std::move(text);
}

bool AgentContext::take_due_timer(TimerId id) {
  const auto timer = timers.find(id);
  if (timer == timers.end() || timer->second > now) return false;
  timers.erase(timer);
  return true;
}

}  // namespace hal::runtime
