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
  /// Errors: as ControllerHost::create. All arguments except `session` outlive the agent.
  static hal::Result<std::unique_ptr<Agent>> create(
      const hal::ControllerKind& kind, const hal::node::exchange::AgentSession& session,
      const hal::node::exchange::Directory& directory, Outbox& outbox);

  const hal::node::exchange::AgentSession& session() const { return context_.session; }
  /// Whether it has been handed its START; another START is for a new controller.
  bool has_started() const { return started_; }

  /// Updates the state from the event and calls the corresponding callback.
  void handle(const hal::node::exchange::Event& event);
  /// Ends the agent: it is handed no more events, and the run is told the reason.
  void die(const char* message);

 private:
  Agent(const hal::ControllerKind& kind, const hal::node::exchange::AgentSession& session,
        const hal::node::exchange::Directory& directory, Outbox& outbox);
  void make_controller(const hal::ControllerKind& kind);
  void call_back(const hal::node::exchange::Event& event);

  AgentContext context_;
  const std::string who_;  ///< Name for messages.
  std::unique_ptr<hal::RealWorldObject> object_;
  std::unique_ptr<hal::Controller> controller_;  ///< Destroyed before the object it refers to.
  bool started_ = false, over_ = false;
};

}  // namespace gateway::runtime
