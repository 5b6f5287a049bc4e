#include "controllers/ros_base/diagnostics.h"

namespace controllers {
namespace {

using diagnostic_msgs::msg::dds_::DiagnosticStatus_;
using diagnostic_msgs::msg::dds_::KeyValue_;

// diagnostic_msgs/DiagnosticStatus.msg.
constexpr std::uint8_t kOk = 0, kWarn = 1, kStale = 3;

KeyValue_ key_value(const std::string& key, std::uint64_t value) {
  KeyValue_ pair;
  pair.key(key);
  pair.value(std::to_string(value));
  return pair;
}

}  // namespace

void Diagnostics::observe(const hal::Robot& robot) {
  for (const hal::Channel& channel : robot.channels()) {
    if (robot.reading(channel.name)) ++readings_[channel.name];
  }
}

std::vector<DiagnosticStatus_> Diagnostics::statuses(const hal::Robot& robot,
                                                     const std::string& state,
                                                     std::uint64_t commands) {
  std::vector<DiagnosticStatus_> all;
  for (const hal::Channel& channel : robot.channels())
    all.push_back(status_of_channel(robot, channel.name));
  DiagnosticStatus_ driving = status(robot, "commands");
  driving.level(state == "stopped" ? kWarn : kOk);
  driving.message(state);
  driving.values({key_value("commands", commands)});
  all.push_back(driving);
  return all;
}

DiagnosticStatus_ Diagnostics::status(const hal::Robot& robot, const std::string& task) const {
  DiagnosticStatus_ one;
  one.name(node_ + ": " + task);
  one.hardware_id(std::string(robot.name()));
  return one;
}

DiagnosticStatus_ Diagnostics::status_of_channel(const hal::Robot& robot,
                                                 const std::string& channel) const {
  DiagnosticStatus_ one = status(robot, channel);
  const auto reading = robot.reading(channel);
  one.level(reading ? kOk : kStale);
  one.message(reading ? "readings" : reading.error().message);
  const auto counted = readings_.find(channel);
  one.values({key_value("cycles_with_reading", counted == readings_.end() ? 0 : counted->second)});
  return one;
}

}  // namespace controllers
