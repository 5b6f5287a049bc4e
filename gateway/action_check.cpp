#include "gateway/action_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

GrantedAgents::GrantedAgents(std::vector<AgentSession> sessions) : sessions_(std::move(sessions)) {
  for (std::size_t i = 0; i < sessions_.size(); ++i) {
    const std::size_t address = sessions_[i].agent.value;
    if (address >= index_.size()) index_.resize(address + 1, kNone);
    index_[address] = static_cast<std::uint32_t>(i);
  }
}

const AgentSession* GrantedAgents::find(hal::AgentId agent) const {
  if (agent.value >= index_.size() || index_[agent.value] == kNone) return nullptr;
  return &sessions_[index_[agent.value]];
}

ActionVerdict judge(const Action& action, const GrantedAgents& granted,
                    const std::vector<Asked>& asked) {
  const AgentSession* session = granted.find(action.agent);
  if (session == nullptr) return ActionVerdict::kForeign;
  if (action.event >= asked.size()) return ActionVerdict::kMalformed;
  const Asked& event = asked[action.event];
  if (event.agent != action.agent) return ActionVerdict::kMalformed;
  return is_well_formed(action, *session, event.time) ? ActionVerdict::kGood
                                                      : ActionVerdict::kMalformed;
}

}  // namespace gateway
