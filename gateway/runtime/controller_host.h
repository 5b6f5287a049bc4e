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

/// The controllers of one process: Steps go in, their events become callbacks, and what the
/// controllers do comes out as the actions of a Reply.
///
///   auto host = ControllerHost::create(*baraka_controller(), session);
///   reply = (*host)->answer(step);
///
/// One thread at a time.
class ControllerHost {
 public:
  /// Makes a controller for every agent of the session. `kind` outlives the host.
  /// Errors, one line each: kInvalidArgument (parameters, as "file:line:column: name: what is
  /// wrong"; an agent of a kind that the controller does not drive), kController (a constructor
  /// threw).
  static hal::Result<std::unique_ptr<ControllerHost>> create(
      const hal::ControllerKind& kind, const hal::node::exchange::Session& session);
  ~ControllerHost();
  ControllerHost(const ControllerHost&) = delete;
  ControllerHost& operator=(const ControllerHost&) = delete;

  /// Works off the events in their order. Never fails: a controller that throws leaves a
  /// ControllerFailed with its message, and gets no callback any more; an event for an agent that
  /// is not of the session leaves a ControllerFailed naming it. The second Start of an agent, and
  /// each further one, is for a controller that is made anew and knows nothing of the one before.
  /// `Reply::process` is for the caller to fill in.
  hal::node::exchange::Reply answer(const hal::node::exchange::Step& step);

  /// Instead of the rest of answer(step), for a callback that does not return: what there is of the
  /// Reply, with a ControllerFailed of `message` for the agent of that callback.
  hal::node::exchange::Reply broken_off(const hal::node::exchange::Step& step, std::string message);

 private:
  ControllerHost(const hal::ControllerKind& kind, const hal::node::exchange::Session& session);
  void make_anew(std::unique_ptr<Agent>& agent);
  hal::node::exchange::Reply gathered(const hal::node::exchange::Step& step);

  const hal::ControllerKind& kind_;
  const hal::node::exchange::Directory directory_;  ///< Of all agents of the process.
  std::unique_ptr<Outbox> outbox_;                  ///< Outlives the agents, which write into it.
  hal::node::exchange::AgentTable<std::unique_ptr<Agent>> agents_;
};

}  // namespace gateway::runtime
