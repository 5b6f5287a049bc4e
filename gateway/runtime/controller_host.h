#pragma once

#include <memory>
#include <string>

#include "hal/api/controller.h"
#include "hal/node/exchange/agent_table.h"
#include "hal/node/exchange/directory.h"
#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace gateway::runtime {

class Agent;
class Outbox;

/// The controllers of one process. The events of a Step become callbacks; the calls of the
/// controllers become the actions of a Reply.
///
///   auto host = ControllerHost::create(*baraka_controller(), session);
///   reply = (*host)->answer(step);
///
/// One thread at a time.
class ControllerHost {
 public:
  /// Creates a controller for every agent of the session. `kind` outlives the host. Errors, one
  /// line each: kInvalidArgument (parameters, as "file:line:column: name: what is wrong"; an agent
  /// of a kind that the controller does not drive), kController (a constructor threw).
  static hal::Result<std::unique_ptr<ControllerHost>> create(
      const hal::ControllerKind& kind, const hal::node::exchange::Session& session);
  ~ControllerHost();
  ControllerHost(const ControllerHost&) = delete;
  ControllerHost& operator=(const ControllerHost&) = delete;

  /// Handles the events in their order. Never fails: for a controller that throws, the Reply has a
  /// ControllerFailed with its message, and the controller gets no more callbacks; for an event of
  /// an agent that is not in the session, the Reply has a ControllerFailed naming the agent. The
  /// second and each later Start of an agent creates a new controller, which knows nothing of the
  /// previous one. `Reply::process` is left to the caller.
  hal::node::exchange::Reply answer(const hal::node::exchange::Step& step);

  /// Replaces the rest of answer(step) if a callback does not return: the Reply so far, with a
  /// ControllerFailed of `message` for the agent of that callback.
  hal::node::exchange::Reply broken_off(const hal::node::exchange::Step& step, std::string message);

 private:
  ControllerHost(const hal::ControllerKind& kind, const hal::node::exchange::Session& session);
  void make_anew(std::unique_ptr<Agent>& agent);
  hal::node::exchange::Reply gathered(const hal::node::exchange::Step& step);

  const hal::ControllerKind& kind_;
  const hal::node::exchange::Directory directory_;  ///< All agents of the process.
  std::unique_ptr<Outbox> outbox_;                  ///< Outlives the agents, which write into it.
  hal::node::exchange::AgentTable<std::unique_ptr<Agent>> agents_;
};

}  // namespace gateway::runtime
