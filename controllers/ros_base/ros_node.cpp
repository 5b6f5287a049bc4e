#include "controllers/ros_base/ros_node.h"

#include <chrono>

#include "controllers/ros/ros_parameters.h"
#include "controllers/ros/ros_participant.h"
#include "controllers/ros_base/command_box.h"
#include "hal/types/math.h"
#include "inspectPubSubTypes.h"

namespace controllers {
namespace {

namespace api = eprosima::fastdds::dds;
using geometry_msgs::msg::dds_::Twist_PubSubType;
using nav_msgs::msg::dds_::Odometry_;
using nav_msgs::msg::dds_::Odometry_PubSubType;
using tf2_msgs::msg::dds_::TFMessage_;
using tf2_msgs::msg::dds_::TFMessage_PubSubType;

/// History depth of tf2_ros's writer of transforms.
constexpr int kDepthOfTransforms = 100;

builtin_interfaces::msg::dds_::Time_ stamp_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  builtin_interfaces::msg::dds_::Time_ stamp;
  stamp.sec(static_cast<std::int32_t>(seconds.count()));
  stamp.nanosec(static_cast<std::uint32_t>(std::chrono::nanoseconds(now - seconds).count()));
  return stamp;
}

geometry_msgs::msg::dds_::Quaternion_ about_z(double theta) {
  geometry_msgs::msg::dds_::Quaternion_ rotation;
  rotation.z(hal::math::sin(theta / 2));
  rotation.w(hal::math::cos(theta / 2));
  return rotation;
}

}  // namespace

class RosNode::Implementation {
 public:
  explicit Implementation(const Settings& settings)
      : settings_(settings),
        participant_(
            {.interface = settings.interface, .domain = settings.domain, .name = "ros_base"}),
        odometry_(participant_.writer(
            participant_.topic<Odometry_PubSubType>(ros_topic(settings.name_space, "odom")),
            RosParticipant::kDepth)),
        // All robots share the topic of transforms: their frames distinguish them.
        transforms_(participant_.writer(
            participant_.topic<TFMessage_PubSubType>(ros_topic("", "tf")), kDepthOfTransforms)) {
    participant_.reader(
        participant_.topic<Twist_PubSubType>(ros_topic(settings.name_space, "cmd_vel")),
        settings.best_effort, &commands_);
  }

  Commands take_commands() { return commands_.take(); }

  void publish(const hal::Odometry& odometry) {
    const auto stamp = stamp_now();
    publish_odometry(odometry, stamp);
    publish_transform(odometry.pose, stamp);
  }

 private:
  using Stamp = builtin_interfaces::msg::dds_::Time_;

  void publish_odometry(const hal::Odometry& odometry, const Stamp& stamp) {
    Odometry_ message;
    message.header().stamp(stamp);
    message.header().frame_id(settings_.odom_frame);
    message.child_frame_id(settings_.base_frame);
    message.pose().pose().position().x(odometry.pose.x);
    message.pose().pose().position().y(odometry.pose.y);
    message.pose().pose().orientation(about_z(odometry.pose.theta));
    message.twist().twist().linear().x(odometry.twist.vx);
    message.twist().twist().linear().y(odometry.twist.vy);
    message.twist().twist().angular().z(odometry.twist.omega);
    odometry_->write(&message);
  }

  void publish_transform(const hal::Pose2& pose, const Stamp& stamp) {
    geometry_msgs::msg::dds_::TransformStamped_ one;
    one.header().stamp(stamp);
    one.header().frame_id(settings_.odom_frame);
    one.child_frame_id(settings_.base_frame);
    one.transform().translation().x(pose.x);
    one.transform().translation().y(pose.y);
    one.transform().rotation(about_z(pose.theta));
    TFMessage_ message;
    message.transforms({one});
    transforms_->write(&message);
  }

  const Settings settings_;
  CommandBox commands_;
  RosParticipant participant_;  // declared after the listeners of its readers
  api::DataWriter* odometry_;
  api::DataWriter* transforms_;
};

RosNode::RosNode(const Settings& settings)
    : implementation_(std::make_unique<Implementation>(settings)) {}
RosNode::~RosNode() = default;

RosNode::Commands RosNode::take_commands() { return implementation_->take_commands(); }
void RosNode::publish(const hal::Odometry& odometry) { implementation_->publish(odometry); }

}  // namespace controllers
