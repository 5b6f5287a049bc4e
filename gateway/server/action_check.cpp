#include "gateway/server/action_check.h"

#include <algorithm>

namespace gateway::server {
using hal::node::exchange::Action;
using hal::node::exchange::AgentSession;

ActionVerdict judge(const Action& action, const std::vector<AgentSession>& granted,
                    const std::vector<hal::AgentId>& asked) {
  // All events of a Step are for agents of the process.
  if (action.event < asked.size() && asked[action.event] == action.agent) {
    return ActionVerdict::kGood;
  }
  const bool is_granted =
      std::ranges::find(granted, action.agent, &AgentSession::agent) != granted.end();
  return is_granted ? ActionVerdict::kMalformed : ActionVerdict::kForeign;
}

}  // namespace gateway::server
