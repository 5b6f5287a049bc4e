#include "hal/runtime/agent_context.h"

#include <fmt/core.h>

#include "hal/exchange/validate.h"

namespace hal::runtime {
namespace {

std::vector<std::string> names_of(const std::vector<RecordSpec>& records) {
  std::vector<std::string> names;
  names.reserve(records.size());
  for (const RecordSpec& record : records) names.push_back(record.name);
  return names;
}

}  // namespace

AgentContext::AgentContext(const exchange::AgentSession& agent_session, const ControllerKind& kind,
                           Outbox& out, const exchange::Directory& names)
    : session(agent_session),
      states(kind.states),
      records(names_of(kind.records)),
      outbox(out),
      readings(agent_session.channels),
      routes(kind.wants.watched, kind.wants.neighbours),
      random(agent_session.seed, agent_session.name + "/controller"),
      directory(names),
      asked_for_names(kind.wants.names) {}

void AgentContext::take_in(const exchange::Event& event) {
  now = event.time;
  for (const exchange::Reading& reading : event.readings) {
    const Result<void> held = readings.hold(reading);
    if (!held) log(log::Level::kError, fmt::format("{}: {}", session.name, held.error().message));
  }
  routes.take_in(event);
}

tl::unexpected<Error> AgentContext::refuse(std::string_view call, std::string_view mistake) {
  std::string text = fmt::format("{}: {}: {}", session.name, call, mistake);
  if (auto line = mistakes.add(text)) log(log::Level::kWarning, std::move(*line));
  last_refusal = text;
  return fail(Errc::kInvalidArgument, std::move(text));
}

Result<void> AgentContext::judge_last() {
  const exchange::Action& action = outbox.last();
  const auto good = exchange::validate(action, session);
  if (good) return {};
  const std::string_view call = exchange::name(action.kind);
  outbox.take_back();
  return refuse(call, good.error().message);
}

bool AgentContext::has_names(std::string_view call) {
  if (!asked_for_names) {
    (void)refuse(call, "the controller did not ask for it: .wants = {.names = true}");
  }
  return asked_for_names;
}

void AgentContext::log_mistakes() {
  for (std::string& line : mistakes.rest()) log(log::Level::kWarning, std::move(line));
}

void AgentContext::log_of_controller(log::Level level, std::string_view text) {
  if (text != last_refusal) log(level, std::string(text));
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
