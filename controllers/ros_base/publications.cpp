#include "controllers/ros_base/publications.h"

#include <algorithm>

#include "controllers/ros_base/urdf.h"
#include "idl/ros/values.h"
#include "ros_nodes.h"

namespace controllers {
namespace {

using idl::ros::to_ros;

/// Of diagnostic_updater.
constexpr hal::Duration kDiagnosticPeriod{1'000'000'000};
/// Rows and columns of a covariance: x, y, z, roll, pitch, yaw.
constexpr std::size_t kSize = 6;

void put_variances(const std::array<double, kSize>& variances,
                   std::array<double, kSize * kSize>& covariance) {
  for (std::size_t i = 0; i < kSize; ++i) covariance[i * kSize + i] = variances[i];
}

std::vector<WheelLink> driven_wheels(const hal::RobotBody& body) {
  std::vector<WheelLink> wheels = wheel_links(body);
  std::erase_if(wheels, [](const WheelLink& wheel) { return !wheel.wheel.is_driven; });
  return wheels;
}

}  // namespace

Publications::Publications(const hal::Robot& robot, const BaseSettings& settings, RosNode& node)
    : robot_(robot),
      settings_(settings),
      node_(node),
      driven_(driven_wheels(robot.body())),
      wheels_(robot.body()),
      diagnostics_(RosNode::kName) {
  add_sensor<idl::ros::Scan>("scan");
  add_sensor<idl::ros::Imu>("imu");
  add_sensor<idl::ros::Battery>("battery_state");
  add_sensor<idl::ros::Bumper>("bumper");
}

template <class Kind>
void Publications::add_sensor(const char* topic) {
  const auto channels = robot_.channels();
  const auto found = std::ranges::find(channels, Kind::kKind, &hal::Channel::name);
  if (found == channels.end() || !node_.offers(topic)) return;
  const std::string link(sensor_link(found->name));
  sensors_.push_back(
      std::make_unique<SensorTopicOf<Kind>>(topic, *found, frame(link.empty() ? kBaseLink : link)));
}

Publications::Transform Publications::transform(const std::string& parent, const std::string& child,
                                                const hal::Vec3& at, double yaw) const {
  return idl::ros::transform_between(frame(parent), frame(child), at, yaw);
}

void Publications::announce() {
  if (node_.offers("tf_static")) {
    tf2_msgs::msg::dds_::TFMessage_ fixed;
    if (settings_.base_frame != kBaseLink)
      fixed.transforms().push_back(transform(settings_.base_frame, kBaseLink, {}, 0));
    for (const FixedLink& one : fixed_links(robot_.channels(), robot_.body()))
      fixed.transforms().push_back(transform(kBaseLink, one.link, one.at, one.yaw));
    const Stamp stamp = node_.stamp(robot_.now());
    for (Transform& one : fixed.transforms()) one.header().stamp(stamp);
    node_.write("tf_static", fixed);
  }
  if (node_.offers("robot_description")) {
    std_msgs::msg::dds_::String_ description;
    description.data(urdf_of(robot_.body(), robot_.channels(), settings_.base_frame));
    node_.write("robot_description", description);
  }
}

void Publications::publish(const Activity& activity) {
  const Stamp stamp = node_.stamp(robot_.now());
  if (const auto odometry = robot_.odometry()) {
    wheels_.update(*odometry);
    publish_odometry(*odometry, stamp);
    publish_transforms(odometry->pose, stamp);
    publish_joints(stamp);
  }
  for (const auto& sensor : sensors_) sensor->publish(robot_, node_, stamp);
  publish_diagnostics(activity, stamp);
  if (node_.offers("clock")) {
    rosgraph_msgs::msg::dds_::Clock_ clock;
    clock.clock(to_ros(robot_.now()));
    node_.write("clock", clock);
  }
}

void Publications::publish_odometry(const hal::Odometry& odometry, const Stamp& stamp) {
  if (!node_.offers("odom")) return;
  nav_msgs::msg::dds_::Odometry_ message;
  message.header().stamp(stamp);
  message.header().frame_id(frame(settings_.odom_frame));
  message.child_frame_id(frame(settings_.base_frame));
  message.pose().pose(to_ros(odometry.pose));
  message.twist().twist(to_ros(odometry.twist));
  put_variances(settings_.pose_variances, message.pose().covariance());
  put_variances(settings_.twist_variances, message.twist().covariance());
  node_.write("odom", message);
}

void Publications::publish_transforms(const hal::Pose2& pose, const Stamp& stamp) {
  if (!node_.offers("tf")) return;
  tf2_msgs::msg::dds_::TFMessage_ message;
  message.transforms().push_back(
      transform(settings_.odom_frame, settings_.base_frame, {pose.x, pose.y, 0}, pose.theta));
  if (node_.offers("joint_states")) {
    for (std::size_t i = 0; i < driven_.size(); ++i) {
      const WheelLink& wheel = driven_[i];
      Transform turned = transform(kBaseLink, wheel.link(), wheel.centre(), 0);
      turned.transform().rotation(wheel_rotation(wheel, wheels_.angles()[i]));
      message.transforms().push_back(turned);
    }
  }
  for (Transform& one : message.transforms()) one.header().stamp(stamp);
  node_.write("tf", message);
}

void Publications::publish_joints(const Stamp& stamp) {
  if (!node_.offers("joint_states")) return;
  sensor_msgs::msg::dds_::JointState_ message;
  message.header().stamp(stamp);
  message.header().frame_id(frame(kBaseLink));
  for (const WheelLink& wheel : driven_) message.name().push_back(wheel.joint());
  message.position(wheels_.angles());
  message.velocity(wheels_.speeds());
  node_.write("joint_states", message);
}

void Publications::publish_diagnostics(const Activity& activity, const Stamp& stamp) {
  if (!node_.offers("diagnostics")) return;
  diagnostics_.observe(robot_);
  if (diagnostics_due_ && robot_.now() < *diagnostics_due_) return;
  diagnostics_due_ = diagnostics_due_.value_or(robot_.now()) + kDiagnosticPeriod;
  diagnostic_msgs::msg::dds_::DiagnosticArray_ message;
  message.header().stamp(stamp);
  message.status(diagnostics_.statuses(robot_, activity.state, activity.commands));
  node_.write("diagnostics", message);
}

}  // namespace controllers
