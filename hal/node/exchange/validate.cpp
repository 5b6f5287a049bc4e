#include "hal/node/exchange/validate.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "hal/types/message.h"
#include "hal/types/overloaded.h"
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
    // Written so that NaN, which compares false with everything, is rejected.
    if (std::abs(speeds[i]) <= limits.wheel_speed) continue;
    return fmt::format("speeds[{}] is {} rad/s, the limit is {} rad/s", i, speeds[i],
                       limits.wheel_speed);
  }
  return {};
}

/// Checks a name. @param field  name of the field for the message, e.g. "topic".
std::string mistake_in_name(const char* field, std::string_view name, std::size_t longest) {
  if (name.find('\0') != std::string_view::npos) return fmt::format("{} has a zero byte", field);
  if (!name.empty() && name.size() <= longest) return {};
  return fmt::format("{} '{}' has {} bytes, 1 to {} are allowed", field, name, name.size(),
                     longest);
}

std::string mistake_in_topic(std::string_view topic) {
  return mistake_in_name("topic", topic, kMaxTopic);
}

std::string mistake_in_record(const Record& record) {
  std::string mistake = mistake_in_name("name", record.name, kMaxRecordedName);
  if (!mistake.empty() || std::isfinite(record.value)) return mistake;
  return fmt::format("'{}' is {}, it must be finite", record.name, record.value);
}

std::string mistake_in_message(const Send& message, const AgentSession& session) {
  if (message.destination == session.agent) {
    return fmt::format("destination {} is this agent itself", message.destination.value);
  }
  if (message.destination == AgentId{}) return "destination is 0, agents have addresses from 1";
  if (message.id == 0) return "the message has number 0, they are numbered from 1";
  if (message.payload.size() > kMaxPayload) {
    return fmt::format("payload has {} bytes, at most {} are allowed", message.payload.size(),
                       kMaxPayload);
  }
  if (to_number(message.priority) > kHighestPriority) {
    return fmt::format("priority is {}, 0 to {} are allowed", to_number(message.priority),
                       kHighestPriority);
  }
  return mistake_in_topic(message.topic);
}

std::string mistake_in(const Action& action, const AgentSession& session) {
  if (drives(action) && session.limits.body_to_wheel.empty()) return "the agent has no wheels";
  return std::visit(Overloaded{
                        [](const DriveBody& drive) { return mistake_in_twist(drive.twist); },
                        [&](const DriveWheels& drive) {
                          return mistake_in_wheel_speeds(drive.speeds, session.limits);
                        },
                        [&](const Send& message) { return mistake_in_message(message, session); },
                        [](const Invalidate& routes) { return mistake_in_topic(routes.topic); },
                        [](const Record& record) { return mistake_in_record(record); },
                        [](const auto& /*always in order*/) { return std::string(); },
                    },
                    action.what);
}

}  // namespace

Result<void> validate(const Action& action, const AgentSession& session) {
  std::string mistake = mistake_in(action, session);
  if (mistake.empty()) return {};
  return fail(Errc::kInvalidArgument, std::move(mistake));
}

std::string_view name(const Action& action) {
  using Name = std::string_view;
  return std::visit(Overloaded{
                        [](const DriveBody&) -> Name { return "set_body_velocity"; },
                        [](const DriveWheels&) -> Name { return "set_wheel_speeds"; },
                        [](const Send&) -> Name { return "send"; },
                        [](const Invalidate&) -> Name { return "invalidate"; },
                        [](const SetTimer&) -> Name { return "set_timer"; },
                        [](const SetRadio&) -> Name { return "set_radio"; },
                        [](const SetState&) -> Name { return "state"; },
                        [](const Log&) -> Name { return "log"; },
                        [](const ControllerFailed&) -> Name { return "error"; },
                        [](const Record&) -> Name { return "record"; },
                    },
                    action.what);
}

}  // namespace hal::node::exchange
