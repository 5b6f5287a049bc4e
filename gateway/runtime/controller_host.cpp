#include "gateway/runtime/controller_host.h"

#include <fmt/core.h>

#include <utility>
#include <variant>

#include "gateway/runtime/agent.h"
#include "gateway/runtime/outbox.h"
#include "hal/types/overloaded.h"

namespace gateway::runtime {

ControllerHost::ControllerHost(const hal::ControllerKind& kind,
                               const hal::node::exchange::Session& session)
    : kind_(kind), directory_(session.directory), outbox_(std::make_unique<Outbox>()) {}
ControllerHost::~ControllerHost() = default;

hal::Result<std::unique_ptr<ControllerHost>> ControllerHost::create(
    const hal::ControllerKind& kind, const hal::node::exchange::Session& session) {
  std::unique_ptr<ControllerHost> host(new ControllerHost(kind, session));
  std::string mistakes;
  hal::Errc code = hal::Errc::kInvalidArgument;
  for (const hal::node::exchange::AgentSession& one : session.agents) {
    auto agent = Agent::create(kind, one, host->directory_, *host->outbox_);
    if (agent) {
      host->agents_[one.agent] = std::move(*agent);
      continue;
    }
    code = agent.error().code;
    mistakes += (mistakes.empty() ? "" : "\n") + agent.error().message;
  }
  if (!mistakes.empty()) return hal::fail(code, std::move(mistakes));
  return host;
}

namespace {

void cut_at_zero(std::string& text) {
  const std::size_t zero = text.find('\0');
  if (zero != std::string::npos) text.resize(zero);
}

/// DDS ends strings at a zero byte, so strings in this process are cut there as well. In all other
/// strings exchange::validate() allows no zero byte.
void cut_at_zero(hal::node::exchange::Action& action) {
  std::visit(hal::Overloaded{
                 [](hal::node::exchange::SetState& state) { cut_at_zero(state.name); },
                 [](hal::node::exchange::Log& line) { cut_at_zero(line.text); },
                 [](hal::node::exchange::ControllerFailed& error) { cut_at_zero(error.text); },
                 [](auto& /*without such a text*/) {},
             },
             action.what);
}

}  // namespace

/// If the creation fails, the constructor threw; the old agent remains, but is handed no more
/// events.
void ControllerHost::make_anew(std::unique_ptr<Agent>& agent) {
  const hal::node::exchange::AgentSession session = agent->session();
  auto made = Agent::create(kind_, session, directory_, *outbox_);
  if (made) {
    agent = std::move(*made);
  } else {
    agent->die(made.error().message.c_str());
  }
}

hal::node::exchange::Reply ControllerHost::answer(const hal::node::exchange::Step& step) {
  for (std::size_t i = 0; i < step.events.size(); ++i) {
    const hal::node::exchange::Event& event = step.events[i];
    outbox_->answer(event.agent, static_cast<std::uint32_t>(i));
    if (auto* agent = agents_.find(event.agent); agent != nullptr) {
      if (event.cause() == hal::node::exchange::Cause::kStart && (*agent)->has_started())
        make_anew(*agent);
      (*agent)->handle(event);
      continue;
    }
    outbox_->add(hal::node::exchange::ControllerFailed{
        fmt::format("step {} has an event for agent {}, which is not of the session", step.sequence,
                    event.agent.value)});
  }
  return gathered(step);
}

hal::node::exchange::Reply ControllerHost::broken_off(const hal::node::exchange::Step& step,
                                                      std::string message) {
  outbox_->add(hal::node::exchange::ControllerFailed{std::move(message)});
  return gathered(step);
}

hal::node::exchange::Reply ControllerHost::gathered(const hal::node::exchange::Step& step) {
  hal::node::exchange::Reply reply;
  reply.run = step.run;
  reply.sequence = step.sequence;
  reply.actions = outbox_->take();
  for (hal::node::exchange::Action& action : reply.actions) cut_at_zero(action);
  return reply;
}

}  // namespace gateway::runtime
