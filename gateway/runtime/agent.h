#pragma once

#include <memory>
#include <string>

#include "gateway/runtime/agent_context.h"
#include "hal/api/controller.h"

namespace gateway::runtime {

/// One agent in a controller process: its state, its Mote or Robot, its controller.
///
///   new --Start--> alive --Stop--> over      Once over, events are left alone. One that ends
///   new --Stop--> over                       before it was started is not told to stop.
///   alive --throws-> over
class Agent {
 public:
  /// Errors: as ControllerHost::create. All but `session` outlive the agent.
  static hal::Result<std::unique_ptr<Agent>> create(
      const hal::ControllerKind& kind, const hal::node::exchange::AgentSession& session,
      const hal::node::exchange::Directory& directory, Outbox& outbox);

  const hal::node::exchange::AgentSession& session() const { return context_.session; }
  /// Has been handed its START: another one is for a new controller.
  bool has_started() const { return started_; }

  /// Updates the state from the event and calls the callback that belongs to it.
  void handle(const hal::node::exchange::Event& event);
  /// Is handed nothing more, and tells the run why.
  void die(const char* message);

 private:
  Agent(const hal::ControllerKind& kind, const hal::node::exchange::AgentSession& session,
        const hal::node::exchange::Directory& directory, Outbox& outbox);
  void make_controller(const hal::ControllerKind& kind);
  void call_back(const hal::node::exchange::Event& event);

  AgentContext context_;
  const std::string who_;  ///< For people.
  std::unique_ptr<hal::RealWorldObject> object_;
  std::unique_ptr<hal::Controller> controller_;  ///< Goes before the object it refers to.
  bool started_ = false, over_ = false;
};

}  // namespace gateway::runtime
