#include "gateway/agentd/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "gateway/inspected_ranges.h"
#include "gateway/inspected_readings.h"

namespace gateway {
namespace {

using hal::dds::Inspector;
using Topic = hal::dds::Inspector::Topic;

hal::dds::InspectedRobot describe(const hal::hardware::RobotFile& file) {
  return {.name = file.name,
          .start = std::nullopt,
          .ranges = inspected_ranges(file.robot->infrared),
          .channels = sensor_channels(file)};
}

}  // namespace

TopicPose::TopicPose(hal::dds::InspectionParticipant& participant, const std::string& topic)
    : reader_(participant, topic, [this](const hal::dds::OutsidePose& outside) {
        const std::lock_guard lock(mutex_);
        fix_ = {outside.pose, hal::hardware::BootClock::now()};
      }) {}

hal::Result<hal::hardware::PoseFix> TopicPose::pose() const {
  const std::lock_guard lock(mutex_);
  if (fix_) return *fix_;
  return hal::fail(hal::Errc::kNotAvailable, "no pose has come in yet");
}

void AgentInspection::start(hal::dds::InspectionParticipant& participant) {
  std::vector<hal::dds::InspectedRobot> robots;
  if (is_robot()) robots.push_back(describe(file_));
  inspector_ = std::make_unique<Inspector>(participant, robots, Inspector::Stamps::kTimeOfDay);
}

std::string AgentInspection::name_of(hal::AgentId agent) const {
  if (agent == hal::kEveryone) return "everyone";
  if (agent == hal::kNeighbours) return "neighbours";
  if (agent == file_.address) return file_.name;
  const auto& map = file_.localisation.map;
  const auto known = std::ranges::find(map, agent, &hal::hardware::Landmark::agent);
  return known == map.end() ? fmt::format("agent {}", agent.value) : known->name;
}

void AgentInspection::on_cycle(hal::Time at, hal::AgentId) {
  to_time_of_day_ = std::chrono::system_clock::now().time_since_epoch() - at.time_since_epoch();
}

void AgentInspection::on_pose(hal::Time at, hal::AgentId, const hal::Pose2& pose) {
  if (inspector_) inspector_->publish_transform(time_of_day(at), file_.name, pose);
}

bool AgentInspection::observes(hal::AgentId, const hal::Channel& channel) const {
  const auto topic = topic_of(channel);
  return observes_readings() && topic && inspector_->has_readers(*topic);
}

void AgentInspection::on_reading(hal::Time at, hal::AgentId, const hal::Channel& channel,
                                 std::span<const double> values) {
  publish_reading(*inspector_, time_of_day(at), 0, channel, values);
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

}  // namespace gateway
