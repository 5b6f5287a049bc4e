#pragma once

#include <cstdint>
#include <vector>

#include "hal/exchange/session.h"
#include "hal/exchange/step.h"

namespace gateway {

enum class ActionVerdict {
  kGood,
  kForeign,    ///< For an agent that the process was not granted.
  kMalformed,  ///< It answers no event of its agent; hal/runtime never sends such a one.
};

/// Judges whether an action as it came over the wire, where anyone may have written it, answers an
/// event of the Step. What it asks for is for the host to judge (hal/exchange/validate.h).
/// @param granted  the agents of the process.   @param asked  the agent of each event of the Step.
ActionVerdict judge(const hal::exchange::Action& action,
                    const std::vector<hal::exchange::AgentSession>& granted,
                    const std::vector<hal::AgentId>& asked);

}  // namespace gateway
