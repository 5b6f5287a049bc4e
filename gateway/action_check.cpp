#include "gateway/action_check.h"

#include <algorithm>
#include <cmath>

#include "hal/types/message.h"

namespace gateway {
namespace {

using hal::exchange::Action;
using hal::exchange::ActionKind;
using hal::exchange::AgentSession;

bool is_finite(double value) { return std::isfinite(value); }

bool is_topic(const std::string& topic) { return !topic.empty() && topic.size() <= hal::kMaxTopic; }

bool is_well_formed(const Action& action, const AgentSession& session, hal::Time event_time) {
  switch (action.kind) {
    case ActionKind::kDriveBody:
      return is_finite(action.twist.vx) && is_finite(action.twist.vy) &&
             is_finite(action.twist.omega);
    case ActionKind::kDriveWheels:
      return action.wheel_speeds.size() == session.limits.body_to_wheel.size() &&
             std::ranges::all_of(action.wheel_speeds, is_finite);
    case ActionKind::kSend:
      return is_topic(action.topic) && action.payload.size() <= hal::kMaxPayload;
    case ActionKind::kInvalidate:
      return is_topic(action.topic);
    case ActionKind::kTimer:
      return action.at >= event_time;
    case ActionKind::kRadio:
    case ActionKind::kState:
    case ActionKind::kLog:
    case ActionKind::kError:
      return true;
  }
  return false;
}

}  // namespace

ActionVerdict judge(const Action& action, const std::vector<AgentSession>& granted,
                    const std::vector<Asked>& asked) {
  const auto session = std::ranges::find(granted, action.agent, &AgentSession::agent);
  if (session == granted.end()) return ActionVerdict::kForeign;
  if (action.event >= asked.size()) return ActionVerdict::kMalformed;
  const Asked& event = asked[action.event];
  if (event.agent != action.agent) return ActionVerdict::kMalformed;
  return is_well_formed(action, *session, event.time) ? ActionVerdict::kGood
                                                      : ActionVerdict::kMalformed;
}

}  // namespace gateway
