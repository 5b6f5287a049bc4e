#pragma once

#include <cstdint>
#include <vector>

#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"

namespace gateway::server {

enum class ActionVerdict {
  kGood,
  kForeign,    ///< For an agent that the process was not granted.
  kMalformed,  ///< Answers no event of its agent; gateway/runtime never sends this.
};

/// Checks whether an action from the network, which any program may have written, answers an event
/// of the Step. The host checks its contents (hal/node/exchange/validate.h).
/// @param granted  the agents of the process.   @param asked  the agent of each event of the Step.
ActionVerdict judge(const hal::node::exchange::Action& action,
                    const std::vector<hal::node::exchange::AgentSession>& granted,
                    const std::vector<hal::AgentId>& asked);

}  // namespace gateway::server
