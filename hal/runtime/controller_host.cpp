#include "hal/runtime/controller_host.h"

#include <fmt/core.h>

#include <utility>

#include "hal/runtime/agent.h"
#include "hal/runtime/outbox.h"

namespace hal::runtime {

ControllerHost::ControllerHost(const ControllerKind& kind, const exchange::Session& session)
    : kind_(kind), directory_(session.directory), outbox_(std::make_unique<Outbox>()) {}
ControllerHost::~ControllerHost() = default;

Result<std::unique_ptr<ControllerHost>> ControllerHost::create(const ControllerKind& kind,
                                                               const exchange::Session& session) {
  std::unique_ptr<ControllerHost> host(new ControllerHost(kind, session));
  std::string mistakes;
  Errc code = Errc::kInvalidArgument;
  for (const exchange::AgentSession& one : session.agents) {
    auto agent = Agent::create(kind, one, host->directory_, *host->outbox_);
    if (agent) {
      host->agents_[one.agent] = std::move(*agent);
      continue;
    }
    code = agent.error().code;
    mistakes += (mistakes.empty() ? "" : "\n") + agent.error().message;
  }
  if (!mistakes.empty()) return fail(code, std::move(mistakes));
  return host;
}

namespace {

void cut_at_zero(std::string& text) {
  const std::size_t zero = text.find('\0');
  if (zero != std::string::npos) text.resize(zero);
}

}  // namespace

/// If that fails, the constructor threw; the old one stays and is handed nothing more.
void ControllerHost::make_anew(std::unique_ptr<Agent>& agent) {
  const exchange::AgentSession session = agent->session();
  auto made = Agent::create(kind_, session, directory_, *outbox_);
  if (made) {
    agent = std::move(*made);
  } else {
    agent->die(made.error().message.c_str());
  }
}

exchange::Reply ControllerHost::answer(const exchange::Step& step) {
  for (std::size_t i = 0; i < step.events.size(); ++i) {
    const exchange::Event& event = step.events[i];
    outbox_->answer(event.agent, static_cast<std::uint32_t>(i));
    if (auto* agent = agents_.find(event.agent); agent != nullptr) {
      if (event.cause == exchange::Cause::kStart && (*agent)->has_started()) make_anew(*agent);
      (*agent)->handle(event);
      continue;
    }
    outbox_->add(exchange::ActionKind::kError).text =
        fmt::format("step {} has an event for agent {}, which is not of the session", step.sequence,
                    event.agent.value);
  }
  return gathered(step);
}

exchange::Reply ControllerHost::broken_off(const exchange::Step& step, std::string message) {
  outbox_->add(exchange::ActionKind::kError).text = std::move(message);
  return gathered(step);
}

exchange::Reply ControllerHost::gathered(const exchange::Step& step) {
  exchange::Reply reply;
  reply.run = step.run;
  reply.sequence = step.sequence;
  reply.actions = outbox_->take();
  // DDS ends strings at a zero byte; in process they must not be longer.
  for (exchange::Action& action : reply.actions) cut_at_zero(action.text);
  return reply;
}

}  // namespace hal::runtime
