#pragma once

#include <memory>
#include <string>

#include "hal/api/controller.h"
#include "hal/runtime/agent_context.h"

namespace hal::runtime {

/// One agent in a controller process: its knowledge, its Mote or Robot, its controller.
///
///   new --kStart--> alive --kStop--> over      Once over, events are left alone. One that ends
///   new --kStop--> over                        before it was started is not told to stop.
///   alive --throws-> over
class Agent {
 public:
  /// Errors: as ControllerHost::create. All but `session` outlive the agent.
  static Result<std::unique_ptr<Agent>> create(const ControllerKind& kind,
                                               const exchange::AgentSession& session,
                                               const exchange::Directory& directory,
                                               Outbox& outbox);

  const exchange::AgentSession& session() const { return context_.session; }
  /// Has been handed its START: another one is for a new controller.
  bool has_started() const { return started_; }

  /// Takes in what the event brings and makes the callback it stands for.
  void handle(const exchange::Event& event);
  /// Is handed nothing more, and tells the run why.
  void die(const char* message);

 private:
  Agent(const ControllerKind& kind, const exchange::AgentSession& session,
        const exchange::Directory& directory, Outbox& outbox);
  void make_controller(const ControllerKind& kind);
  void call_back(const exchange::Event& event);
  void receive(const exchange::Event& event);

  AgentContext context_;
  const std::string who_;  ///< For people.
  std::unique_ptr<RealWorldObject> object_;
  std::unique_ptr<Controller> controller_;  ///< Goes before the object it refers to.
  bool started_ = false, over_ = false;
};

}  // namespace hal::runtime
