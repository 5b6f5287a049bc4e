#include "gateway/runtime/agent_context.h"

#include <fmt/core.h>

#include "hal/node/exchange/validate.h"

namespace gateway::runtime {
namespace {

std::vector<std::string> names_of(const std::vector<hal::RecordSpec>& records) {
  std::vector<std::string> names;
  names.reserve(records.size());
  for (const hal::RecordSpec& record : records) names.push_back(record.name);
  return names;
}

}  // namespace

AgentContext::AgentContext(const hal::node::exchange::AgentSession& agent_session,
                           const hal::ControllerKind& kind, Outbox& out,
                           const hal::node::exchange::Directory& names)
    : session(agent_session),
      states(kind.states),
      records(names_of(kind.records)),
      outbox(out),
      readings(agent_session.channels),
      routes(kind.wants.watched, kind.wants.neighbours),
      random(agent_session.seed, agent_session.name + "/controller"),
      directory(names),
      asked_for_names(kind.wants.names) {}

void AgentContext::take_in(const hal::node::exchange::Event& event) {
  now = event.time;
  for (const hal::node::exchange::Reading& reading : event.readings) {
    const hal::Result<void> held = readings.hold(reading);
    if (!held)
      log(hal::log::Level::kError, fmt::format("{}: {}", session.name, held.error().message));
  }
  routes.take_in(event);
}

tl::unexpected<hal::Error> AgentContext::refuse(std::string_view call, std::string_view mistake) {
  std::string text = fmt::format("{}: {}: {}", session.name, call, mistake);
  if (auto line = mistakes.add(text)) log(hal::log::Level::kWarning, std::move(*line));
  last_refusal = text;
  return hal::fail(hal::Errc::kInvalidArgument, std::move(text));
}

hal::Result<void> AgentContext::judge_last() {
  const hal::node::exchange::Action& action = outbox.last();
  const auto good = hal::node::exchange::validate(action, session);
  if (good) return {};
  const std::string_view call = hal::node::exchange::name(action);
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
  for (std::string& line : mistakes.rest()) log(hal::log::Level::kWarning, std::move(line));
}

void AgentContext::log_of_controller(hal::log::Level level, std::string_view text) {
  if (text != last_refusal) log(level, std::string(text));
}

void AgentContext::log(hal::log::Level level, std::string text) {
  outbox.add(hal::node::exchange::Log{level, std::move(text)});
}

bool AgentContext::take_due_timer(hal::TimerId id) {
  const auto timer = timers.find(id);
  if (timer == timers.end() || timer->second > now) return false;
  timers.erase(timer);
  return true;
}

}  // namespace gateway::runtime
