#include "agentd/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "gateway/inspection/inspected_ranges.h"
#include "gateway/inspection/inspected_readings.h"

namespace agentd {
namespace {

using gateway::inspection::Inspector;
using Topic = gateway::inspection::Inspector::Topic;

gateway::inspection::InspectedRobot describe(const hal::robot::agent::RobotFile& file) {
  return {.name = file.name,
          .start = std::nullopt,
          .ranges = gateway::inspection::inspected_ranges(file.robot->infrared),
          .channels = sensor_channels(file)};
}

}  // namespace

TopicPose::TopicPose(gateway::inspection::InspectionParticipant& participant,
                     const std::string& topic)
    : reader_(participant, topic, [this](const gateway::inspection::OutsidePose& outside) {
        const std::lock_guard lock(mutex_);
        fix_ = {outside.pose, hal::robot::platform::BootClock::now()};
      }) {}

hal::Result<hal::robot::agent::PoseFix> TopicPose::pose() const {
  const std::lock_guard lock(mutex_);
  if (fix_) return *fix_;
  return hal::fail(hal::Errc::kNotAvailable, "no pose has come in yet");
}

void AgentInspection::start(gateway::inspection::InspectionParticipant& participant) {
  std::vector<gateway::inspection::InspectedRobot> robots;
  if (is_robot()) robots.push_back(describe(file_));
  inspector_ = std::make_unique<Inspector>(participant, robots, Inspector::Stamps::kTimeOfDay);
}

std::string AgentInspection::name_of(hal::AgentId agent) const {
  if (agent == hal::kEveryone) return "everyone";
  if (agent == hal::kNeighbours) return "neighbours";
  if (agent == file_.address) return file_.name;
  const auto& map = file_.localisation.map;
  const auto known = std::ranges::find(map, agent, &hal::robot::agent::Landmark::agent);
  return known == map.end() ? fmt::format("agent {}", agent.value) : known->name;
}

void AgentInspection::on_cycle(hal::Time at, hal::AgentId) {
  to_time_of_day_ = std::chrono::system_clock::now().time_since_epoch() - at.time_since_epoch();
}

void AgentInspection::on_pose(hal::Time at, hal::AgentId, const hal::Pose2& pose) {
  if (inspector_) inspector_->publish_transform(time_of_day(at), file_.name, pose);
}

bool AgentInspection::observes(hal::AgentId, const hal::Channel& channel) const {
  const auto topic = gateway::inspection::topic_of(channel);
  return observes_readings() && topic && inspector_->has_readers(*topic);
}

void AgentInspection::on_reading(hal::Time at, hal::AgentId, const hal::Channel& channel,
                                 std::span<const double> values) {
  gateway::inspection::publish_reading(*inspector_, time_of_day(at), 0, channel, values);
}

void AgentInspection::on_fate(hal::Time at, hal::AgentId, hal::MessageId id, hal::Fate fate) {
  if (!inspector_ || !inspector_->has_readers(Topic::kFates)) return;
  inspector_->publish_fate(
      time_of_day(at),
      {.sender = file_.name, .id = id, .node = file_.name, .fate = fate, .verdict = {}});
}

void AgentInspection::on_route_change(hal::Time at, hal::AgentId, const hal::RouteChange& change) {
  if (!inspector_ || !inspector_->has_readers(Topic::kRoutes)) return;
  const std::string destination = name_of(change.route.destination);
  const std::string next_hop = name_of(change.route.next_hop);
  inspector_->publish_route(
      time_of_day(at),
      {.agent = file_.name, .destination = destination, .next_hop = next_hop, .change = change});
}

void AgentInspection::on_state(hal::Time at, hal::AgentId, std::string_view state) {
  if (inspector_) inspector_->publish_state(time_of_day(at), file_.name, state);
}

void AgentInspection::on_record(hal::Time at, hal::AgentId, std::string_view name, double value) {
  if (inspector_) inspector_->publish_value(time_of_day(at), file_.name, name, value);
}

}  // namespace agentd
