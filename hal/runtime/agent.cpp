#include "hal/runtime/agent.h"

#include <fmt/core.h>

#include <exception>

#include "hal/exchange/foreign_call.h"
#include "hal/runtime/check_parameters.h"
#include "hal/runtime/object_of.h"
#include "hal/runtime/robot_object.h"

namespace hal::runtime {
namespace {

constexpr const char* kUnknownException = "threw something that is no std::exception";

std::string_view name_of(exchange::Cause cause) {
  switch (cause) {
    case exchange::Cause::kStart:
      return "start()";
    case exchange::Cause::kMessage:
      return "receive()";
    case exchange::Cause::kTimer:
      return "timer()";
    case exchange::Cause::kNotice:
      return "notice()";
    case exchange::Cause::kLink:
      return "";
    case exchange::Cause::kControl:
      return "step()";
    case exchange::Cause::kStop:
      return "stop()";
  }
  return {};
}

std::string mistake_in(const ControllerKind& kind, const exchange::AgentSession& session) {
  const bool is_mote = session.kind == AgentKind::kMote;
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

Agent::Agent(const ControllerKind& kind, const exchange::AgentSession& session,
             const exchange::Directory& directory, Outbox& outbox)
    : context_(session, kind, outbox, directory), who_("controller of " + session.name) {}

void Agent::make_controller(const ControllerKind& kind) {
  const Parameters parameters = read_parameters(kind, context_.session.parameters);
  const exchange::ForeignCall call(who_, "its constructor", Time{});
  if (context_.session.kind == AgentKind::kMote) {
    auto mote = std::make_unique<MoteObject>(context_);
    controller_ = kind.make_for_mote(*mote, parameters);
    object_ = std::move(mote);
  } else {
    auto robot = std::make_unique<RobotObject>(context_);
    controller_ = kind.make_for_robot(*robot, parameters);
    object_ = std::move(robot);
  }
}

Result<std::unique_ptr<Agent>> Agent::create(const ControllerKind& kind,
                                             const exchange::AgentSession& session,
                                             const exchange::Directory& directory, Outbox& outbox) {
  std::string mistakes = mistake_in(kind, session);
  if (!mistakes.empty()) return fail(Errc::kInvalidArgument, std::move(mistakes));
  std::unique_ptr<Agent> agent(new Agent(kind, session, directory, outbox));
  try {
    agent->make_controller(kind);
  } catch (const std::exception& e) {
    return fail(Errc::kController, fmt::format("{}: {}", session.name, e.what()));
  } catch (...) {
    return fail(Errc::kController, fmt::format("{}: {}", session.name, kUnknownException));
  }
  return agent;
}

void Agent::handle(const exchange::Event& event) {
  if (over_) return;
  context_.take_in(event);
  try {
    const exchange::ForeignCall call(who_, name_of(event.cause), event.time);
    const CallGuard::Callback running(context_.guard);
    call_back(event);
  } catch (const std::exception& e) {
    die(e.what());
  } catch (...) {
    die(kUnknownException);
  }
}

void Agent::call_back(const exchange::Event& event) {
  switch (event.cause) {
    case exchange::Cause::kStart:
      started_ = true;
      return controller_->start();
    case exchange::Cause::kMessage:
      return receive(event);
    case exchange::Cause::kTimer:
      if (context_.take_due_timer(event.timer)) controller_->timer(event.timer);
      return;
    case exchange::Cause::kNotice:
      return controller_->notice(event.noticed, event.fate);
    case exchange::Cause::kLink:
      return;
    case exchange::Cause::kControl:
      return controller_->step();
    case exchange::Cause::kStop:
      over_ = true;
      if (started_) controller_->stop();
      return context_.log_mistakes();
  }
}

void Agent::receive(const exchange::Event& event) {
  if (event.message) return controller_->receive(*event.message);
  context_.log(log::Level::kError, context_.session.name + ": a message event without a message");
}

void Agent::die(const char* message) {
  over_ = true;
  context_.outbox.add(exchange::ActionKind::kError).text = message;
}

}  // namespace hal::runtime
