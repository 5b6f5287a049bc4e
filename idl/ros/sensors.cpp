#include "idl/ros/sensors.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "idl/ros/values.h"

namespace idl::ros {
namespace {

geometry_msgs::msg::dds_::Vector3_ vector_of(std::span<const double> values) {
  geometry_msgs::msg::dds_::Vector3_ result;
  result.x(values[0]);
  result.y(values[1]);
  result.z(values[2]);
  return result;
}

}  // namespace

void Battery::describe(Message& message, const std::string& agent, const hal::Channel&) {
  constexpr std::uint8_t kDischarging = 2;  // POWER_SUPPLY_STATUS_DISCHARGING
  constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();
  message.header().frame_id(agent + "/base_link");
  message.temperature(kNotMeasured);
  message.charge(kNotMeasured);
  message.capacity(kNotMeasured);
  message.design_capacity(kNotMeasured);
  message.power_supply_status(kDischarging);
  message.present(true);
}

/// sensor_msgs/BatteryState.msg: the current is negative when discharging.
void Battery::measure(Message& message, hal::Time at, std::span<const double> values) {
  message.header().stamp(to_ros(at));
  message.percentage(static_cast<float>(values[0]));
  message.voltage(static_cast<float>(values[1]));
  message.current(static_cast<float>(-values[2]));
}

void Bumper::measure(Message& message, hal::Time, std::span<const double> values) {
  message.data(values[0] != 0);
}

void Imu::describe(Message& message, const std::string& agent, const hal::Channel& channel) {
  message.header().frame_id(agent + "/" + channel.frame);
  message.orientation_covariance()[0] = -1;  // no orientation is measured
}

void Imu::measure(Message& message, hal::Time at, std::span<const double> values) {
  message.header().stamp(to_ros(at));
  message.angular_velocity(vector_of(values.first(3)));
  message.linear_acceleration(vector_of(values.subspan(3, 3)));
}

void Pose::describe(Message& message, const std::string&, const hal::Channel&) {
  message.header().frame_id("world");
}

void Pose::measure(Message& message, hal::Time at, std::span<const double> values) {
  message.header().stamp(to_ros(at));
  message.pose(to_ros(hal::Pose2{values[0], values[1], values[2]}));
}

void Scan::describe(Message& message, const std::string& agent, const hal::Channel& channel) {
  const std::vector<double>& headings = channel.headings;
  message.header().frame_id(agent + "/" + channel.frame);
  if (!headings.empty()) {
    message.angle_min(static_cast<float>(headings.front()));
    message.angle_max(static_cast<float>(headings.back()));
  }
  if (headings.size() > 1) message.angle_increment(static_cast<float>(headings[1] - headings[0]));
  message.time_increment(0);  // all rays at once
  message.scan_time(static_cast<float>(hal::to_seconds(channel.period)));
  message.range_min(static_cast<float>(channel.low));
  message.range_max(static_cast<float>(channel.high));
}

void Scan::measure(Message& message, hal::Time at, std::span<const double> values) {
  message.header().stamp(to_ros(at));
  message.ranges().resize(values.size());
  std::ranges::transform(values, message.ranges().begin(), to_ros_distance);
}

void Sonar::describe(Message& message, const std::string& agent, const hal::Channel& channel) {
  constexpr std::uint8_t kUltrasound = 0;
  message.header().frame_id(agent + "/" + channel.frame);
  message.radiation_type(kUltrasound);
  if (channel.headings.size() == 2) {
    message.field_of_view(static_cast<float>(channel.headings[1] - channel.headings[0]));
  }
  message.min_range(static_cast<float>(channel.low));
  message.max_range(static_cast<float>(channel.high));
}

void Sonar::measure(Message& message, hal::Time at, std::span<const double> values) {
  message.header().stamp(to_ros(at));
  message.range(to_ros_distance(values[0]));
}

}  // namespace idl::ros
