#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "gateway/inspection/inspector.h"
#include "gateway/inspection/pose_reader.h"
#include "hal/node/agent/agent_observer.h"
#include "hal/robot/agent/localisation.h"
#include "hal/robot/agent/robot_file.h"

namespace agentd {

/// A source of poses from a DDS topic.
class TopicPose final : public hal::robot::agent::PoseSource {
 public:
  /// @param participant  outlives this object.  @throws std::runtime_error  if DDS makes no reader.
  TopicPose(gateway::inspection::InspectionParticipant& participant, const std::string& topic);

  hal::Result<hal::robot::agent::PoseFix> pose() const override;

 private:
  mutable std::mutex mutex_;  ///< Guards fix_, which a thread of DDS writes.
  std::optional<hal::robot::agent::PoseFix> fix_;
  gateway::inspection::PoseReader reader_;
};

/// Shows a real agent on the topics of gateway::inspection::Inspector. As ROS 2 expects of a robot,
/// time stamps are the time of day and nobody publishes rt/clock: several robots share a domain,
/// and programs there have use_sim_time false.
class AgentInspection final : public hal::node::agent::AgentObserver {
 public:
  /// @param file  outlives this object.
  explicit AgentInspection(const hal::robot::agent::RobotFile& file) : file_(file) {}

  /// Nothing is shown before this call. @param participant  outlives this object.
  /// @throws std::runtime_error  if DDS makes no writer.
  void start(gateway::inspection::InspectionParticipant& participant);

  void on_cycle(hal::Time at, hal::AgentId agent) override;
  void on_pose(hal::Time at, hal::AgentId agent, const hal::Pose2& pose) override;
  bool observes_readings() const override { return inspector_ && is_robot(); }
  bool observes(hal::AgentId agent, const hal::Channel& channel) const override;
  void on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override;
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override;
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override;
  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;
  void on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) override;

 private:
  bool is_robot() const { return file_.robot.has_value(); }
  std::string name_of(hal::AgentId agent) const;
  hal::Time time_of_day(hal::Time at) const { return at + to_time_of_day_; }

  const hal::robot::agent::RobotFile& file_;
  std::unique_ptr<gateway::inspection::Inspector> inspector_;  ///< Null until start().
  /// Difference between the time since 1970, UTC, and the loop's time; updated in each cycle,
  /// because the clock of the day is corrected.
  hal::Duration to_time_of_day_{};
};

}  // namespace agentd
