#pragma once

#include <vector>

#include "hal/exchange/session.h"
#include "hal/exchange/step.h"

namespace gateway {

enum class ActionVerdict {
  kGood,
  kForeign,    ///< For an agent that the process was not granted.
  kMalformed,  ///< Against the rules of hal/exchange/step.h; hal/runtime never sends such a one.
};

/// What the server needs to remember of a Step to judge the Reply.
struct Asked {
  hal::AgentId agent;
  hal::Time time{};
};

/// Judges an action as it came over the wire, where anyone may have written it.
/// @param granted  the agents of the process.   @param asked  one per event of the Step.
ActionVerdict judge(const hal::exchange::Action& action,
                    const std::vector<hal::exchange::AgentSession>& granted,
                    const std::vector<Asked>& asked);

}  // namespace gateway
