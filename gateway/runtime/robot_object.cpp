#include "gateway/runtime/robot_object.h"

#include <fmt/core.h>

#include "gateway/runtime/drive.h"

namespace gateway::runtime {

const hal::RobotBody& RobotObject::body() const {
  context().guard.check("body");
  return context().session.body;
}

hal::Result<hal::Drive> RobotObject::set_body_velocity(const hal::Twist2& twist) {
  context().guard.check("set_body_velocity");
  if (context().session.limits.body_to_wheel.empty()) {
    return hal::fail(hal::Errc::kNotAvailable, context().session.name + " has no wheels");
  }
  auto& command = context().outbox.add(hal::node::exchange::DriveBody{twist});
  if (auto good = context().judge_last(); !good) return tl::unexpected(good.error());
  const hal::Drive drive = saturate(context().session.limits, twist);
  command.twist = drive.applied;
  return drive;
}

hal::Result<void> RobotObject::set_wheel_speeds(std::span<const double> speeds) {
  context().guard.check("set_wheel_speeds");
  context().outbox.add(hal::node::exchange::DriveWheels{{speeds.begin(), speeds.end()}});
  return context().judge_last();
}

hal::Result<std::vector<hal::InfraredReading>> RobotObject::infrared() const {
  context().guard.check("infrared");
  const auto ranges = context().readings.values("infrared");
  if (!ranges) return tl::unexpected<hal::Error>(ranges.error());
  const std::vector<double>& headings = context().readings.find("infrared")->headings;
  if (headings.size() != ranges->size()) {
    return hal::fail(
        hal::Errc::kNotAvailable,
        fmt::format("infrared gives {} ranges for {} headings", ranges->size(), headings.size()));
  }
  std::vector<hal::InfraredReading> readings;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    readings.push_back({.heading = headings[i], .range = (*ranges)[i]});
  }
  return readings;
}

hal::Result<hal::Odometry> RobotObject::odometry() const {
  context().guard.check("odometry");
  const auto values = this->values("odometry", 6);
  if (!values) return tl::unexpected<hal::Error>(values.error());
  const auto& v = *values;
  return hal::Odometry{.pose = {v[0], v[1], v[2]}, .twist = {v[3], v[4], v[5]}};
}

hal::Result<hal::Scan> RobotObject::scan() const {
  context().guard.check("scan");
  const hal::Channel* channel = context().readings.find("scan");
  const std::size_t rays = channel == nullptr ? 0 : channel->headings.size();
  const auto ranges = values("scan", rays);
  if (!ranges) return tl::unexpected<hal::Error>(ranges.error());
  return hal::Scan{.headings = channel->headings, .ranges = *ranges};
}

hal::Result<hal::Pose2> RobotObject::pose() const {
  context().guard.check("pose");
  const auto v = values("pose", 3);
  if (!v) return tl::unexpected<hal::Error>(v.error());
  return hal::Pose2{(*v)[0], (*v)[1], (*v)[2]};
}

hal::Result<bool> RobotObject::bumped() const {
  context().guard.check("bumped");
  const auto v = values("bumper", 1);
  if (!v) return tl::unexpected<hal::Error>(v.error());
  return v->front() != 0;
}

hal::Result<hal::Imu> RobotObject::imu() const {
  context().guard.check("imu");
  const auto v = values("imu", 6);
  if (!v) return tl::unexpected<hal::Error>(v.error());
  return hal::Imu{.angular_velocity = {(*v)[0], (*v)[1], (*v)[2]},
                  .specific_force = {(*v)[3], (*v)[4], (*v)[5]}};
}

hal::Result<std::span<const double>> RobotObject::values(const char* channel,
                                                         std::size_t count) const {
  auto values = context().readings.values(channel);
  if (values && values->size() != count) {
    return hal::fail(hal::Errc::kNotAvailable, fmt::format("{} gives {} values instead of {}",
                                                           channel, values->size(), count));
  }
  return values;
}

}  // namespace gateway::runtime
