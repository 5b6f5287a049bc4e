#pragma once

#include <memory>
#include <string>

#include "hal/api/controller.h"
#include "hal/runtime/agent_context.h"

namespace hal::runtime {

/// One agent in a controller process: its knowledge, its Mote or Robot, its controller.
///
///   alive --kStop--> over        Once over, events are left alone.
///   alive --throws-> over
class Agent {
 public:
  /// Errors: as ControllerHost::create. All but `session` outlive the agent.
  static Result<std::unique_ptr<Agent>> create(const ControllerKind& kind,
                                               const exchange::AgentSession& session,
                                               const exchange::Directory& directory,
                                               Outbox& outbox);

  /// Takes in what the event brings and makes the callback it stands for.
  void handle(const exchange::Event& event);

 private:
  Agent(const ControllerKind& kind, const exchange::AgentSession& session,
        const exchange::Directory& directory, Outbox& outbox);
  void make_controller(const ControllerKind& kind);
  void call_back(const exchange::Event& event);
  void receive(const exchange::Event& event);
  void die(const char* message);

  AgentContext context_;
  const std::string who_;  ///< For people.
  std::unique_ptr<RealWorldObject> object_;
  std::unique_ptr<Controller> controller_;  ///< Goes before the object it refers to.
  bool over_ = false;
};

}  // namespace hal::runtime
