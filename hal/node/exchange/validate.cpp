#include "hal/node/exchange/validate.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "hal/types/message.h"
#include "hal/types/record.h"

namespace hal::node::exchange {
namespace {

std::string mistake_in_twist(const Twist2& twist) {
  const std::pair<const char*, double> fields[] = {
      {"vx", twist.vx}, {"vy", twist.vy}, {"omega", twist.omega}};
  for (const auto& [field, value] : fields) {
    if (!std::isfinite(value)) return fmt::format("{} is {}, it must be finite", field, value);
  }
  return {};
}

std::string mistake_in_wheel_speeds(std::span<const double> speeds, const DriveLimits& limits) {
  const std::size_t wheels = limits.body_to_wheel.size();
  if (speeds.size() != wheels) {
    return fmt::format("speeds has {} values, the robot has {} wheels", speeds.size(), wheels);
  }
  for (std::size_t i = 0; i < wheels; ++i) {
    // Written so that NaN, which compares false with everything, is caught too.
    if (std::abs(speeds[i]) <= limits.wheel_speed) continue;
    return fmt::format("speeds[{}] is {} rad/s, the limit is {} rad/s", i, speeds[i],
                       limits.wheel_speed);
  }
  return {};
}

/// @param field  "topic"
std::string mistake_in_name(const char* field, std::string_view name, std::size_t longest) {
  if (name.find('\0') != std::string_view::npos) return fmt::format("{} has a zero byte", field);
  if (!name.empty() && name.size() <= longest) return {};
  return fmt::format("{} '{}' has {} bytes, 1 to {} are allowed", field, name, name.size(),
                     longest);
}

std::string mistake_in_topic(std::string_view topic) {
  return mistake_in_name("topic", topic, kMaxTopic);
}

std::string mistake_in_record(std::string_view name, double value) {
  std::string mistake = mistake_in_name("name", name, kMaxRecordedName);
  if (!mistake.empty() || std::isfinite(value)) return mistake;
  return fmt::format("'{}' is {}, it must be finite", name, value);
}

std::string mistake_in_message(const Action& action, const AgentSession& session) {
  if (action.destination == session.agent) {
    return fmt::format("destination {} is this agent itself", action.destination.value);
  }
  if (action.destination == AgentId{}) return "destination is 0, agents have addresses from 1";
  if (action.message_id == 0) return "the message has number 0, they are numbered from 1";
  if (action.payload.size() > kMaxPayload) {
    return fmt::format("payload has {} bytes, at most {} are allowed", action.payload.size(),
                       kMaxPayload);
  }
  return mistake_in_topic(action.topic);
}

std::string mistake_in(const Action& action, const AgentSession& session) {
  const bool has_wheels = !session.limits.body_to_wheel.empty();
  switch (action.kind) {
    case ActionKind::kDriveBody:
      return has_wheels ? mistake_in_twist(action.twist) : "the agent has no wheels";
    case ActionKind::kDriveWheels:
      return has_wheels ? mistake_in_wheel_speeds(action.wheel_speeds, session.limits)
                        : "the agent has no wheels";
    case ActionKind::kSend:
      return mistake_in_message(action, session);
    case ActionKind::kInvalidate:
      return mistake_in_topic(action.topic);
    case ActionKind::kRecord:
      return mistake_in_record(action.text, action.value);
    case ActionKind::kTimer:
    case ActionKind::kRadio:
    case ActionKind::kState:
    case ActionKind::kLog:
    case ActionKind::kError:
      break;
  }
  return {};
}

}  // namespace

Result<void> validate(const Action& action, const AgentSession& session) {
  std::string mistake = mistake_in(action, session);
  if (mistake.empty()) return {};
  return fail(Errc::kInvalidArgument, std::move(mistake));
}

std::string_view name(ActionKind kind) {
  switch (kind) {
    case ActionKind::kDriveBody:
      return "set_body_velocity";
    case ActionKind::kDriveWheels:
      return "set_wheel_speeds";
    case ActionKind::kSend:
      return "send";
    case ActionKind::kInvalidate:
      return "invalidate";
    case ActionKind::kTimer:
      return "set_timer";
    case ActionKind::kRadio:
      return "set_radio";
    case ActionKind::kState:
      return "state";
    case ActionKind::kLog:
      return "log";
    case ActionKind::kError:
      return "error";
    case ActionKind::kRecord:
      return "record";
  }
  return {};
}

}  // namespace hal::node::exchange
