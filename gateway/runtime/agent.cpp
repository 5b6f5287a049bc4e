#include "gateway/runtime/agent.h"

#include <fmt/core.h>

#include <exception>
#include <variant>

#include "gateway/runtime/check_parameters.h"
#include "gateway/runtime/object_of.h"
#include "gateway/runtime/robot_object.h"
#include "hal/node/exchange/foreign_call.h"
#include "hal/types/overloaded.h"

namespace gateway::runtime {
namespace {

constexpr const char* kUnknownException = "threw something that is no std::exception";

std::string_view name_of(hal::node::exchange::Cause cause) {
  switch (cause) {
    case hal::node::exchange::Cause::kStart:
      return "start()";
    case hal::node::exchange::Cause::kMessage:
      return "receive()";
    case hal::node::exchange::Cause::kTimer:
      return "timer()";
    case hal::node::exchange::Cause::kNotice:
      return "notice()";
    case hal::node::exchange::Cause::kLink:
      return "";
    case hal::node::exchange::Cause::kControl:
      return "step()";
    case hal::node::exchange::Cause::kStop:
      return "stop()";
  }
  return {};
}

std::string mistake_in(const hal::ControllerKind& kind,
                       const hal::node::exchange::AgentSession& session) {
  const bool is_mote = session.kind == hal::AgentKind::kMote;
  const bool can = is_mote ? kind.make_for_mote != nullptr : kind.make_for_robot != nullptr;
  if (!can) {
    return fmt::format("{}: controller {} does not run on {}", session.name, kind.name,
                       is_mote ? "motes" : "robots");
  }
  std::string mistakes;
  for (const std::string& mistake : check_parameters(kind, session.parameters)) {
    mistakes += (mistakes.empty() ? "" : "\n") + mistake;
  }
  return mistakes;
}

}  // namespace

Agent::Agent(const hal::ControllerKind& kind, const hal::node::exchange::AgentSession& session,
             const hal::node::exchange::Directory& directory, Outbox& outbox)
    : context_(session, kind, outbox, directory), who_("controller of " + session.name) {}

void Agent::make_controller(const hal::ControllerKind& kind) {
  const hal::Parameters parameters = read_parameters(kind, context_.session.parameters);
  const hal::node::exchange::ForeignCall call(who_, "its constructor", hal::Time{});
  if (context_.session.kind == hal::AgentKind::kMote) {
    auto mote = std::make_unique<MoteObject>(context_);
    controller_ = kind.make_for_mote(*mote, parameters);
    object_ = std::move(mote);
  } else {
    auto robot = std::make_unique<RobotObject>(context_);
    controller_ = kind.make_for_robot(*robot, parameters);
    object_ = std::move(robot);
  }
}

hal::Result<std::unique_ptr<Agent>> Agent::create(const hal::ControllerKind& kind,
                                                  const hal::node::exchange::AgentSession& session,
                                                  const hal::node::exchange::Directory& directory,
                                                  Outbox& outbox) {
  std::string mistakes = mistake_in(kind, session);
  if (!mistakes.empty()) return hal::fail(hal::Errc::kInvalidArgument, std::move(mistakes));
  std::unique_ptr<Agent> agent(new Agent(kind, session, directory, outbox));
  try {
    agent->make_controller(kind);
  } catch (const std::exception& e) {
    return hal::fail(hal::Errc::kController, fmt::format("{}: {}", session.name, e.what()));
  } catch (...) {
    return hal::fail(hal::Errc::kController,
                     fmt::format("{}: {}", session.name, kUnknownException));
  }
  return agent;
}

void Agent::handle(const hal::node::exchange::Event& event) {
  if (over_) return;
  context_.take_in(event);
  try {
    const hal::node::exchange::ForeignCall call(who_, name_of(event.cause()), event.time);
    const CallGuard::Callback running(context_.guard);
    call_back(event);
  } catch (const std::exception& e) {
    die(e.what());
  } catch (...) {
    die(kUnknownException);
  }
}

void Agent::call_back(const hal::node::exchange::Event& event) {
  std::visit(hal::Overloaded{
                 [this](const hal::node::exchange::Start&) {
                   started_ = true;
                   controller_->start();
                 },
                 [this](const hal::node::exchange::MessageArrived& arrived) {
                   controller_->receive(arrived.message);
                 },
                 [this](const hal::node::exchange::TimerDue& due) {
                   if (context_.take_due_timer(due.timer)) controller_->timer(due.timer);
                 },
                 [this](const hal::node::exchange::Notice& notice) {
                   controller_->notice(notice.message, notice.fate);
                 },
                 [](const hal::node::exchange::LinkChanged&) {},
                 [this](const hal::node::exchange::ControlDue&) { controller_->step(); },
                 [this](const hal::node::exchange::Stop&) {
                   over_ = true;
                   if (started_) controller_->stop();
                   context_.log_mistakes();
                 },
             },
             event.what);
}

void Agent::die(const char* message) {
  over_ = true;
  context_.outbox.add(hal::node::exchange::ControllerFailed{message});
}

}  // namespace gateway::runtime
