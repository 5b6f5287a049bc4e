#include "controllers/ros_operator/operator_node.h"

#include "controllers/ros/ros_parameters.h"
#include "controllers/ros/ros_participant.h"
#include "controllers/ros_operator/odometry_counter.h"
#include "inspectPubSubTypes.h"

namespace controllers {
namespace {

namespace api = eprosima::fastdds::dds;
using geometry_msgs::msg::dds_::Twist_;
using geometry_msgs::msg::dds_::Twist_PubSubType;
using nav_msgs::msg::dds_::Odometry_PubSubType;

}  // namespace

class OperatorNode::Implementation {
 public:
  explicit Implementation(const Settings& settings)
      : participant_(
            {.interface = settings.interface, .domain = settings.domain, .name = "ros_operator"}) {
    for (const std::string& robot : settings.robots) {
      writers_.push_back(participant_.writer(
          participant_.topic<Twist_PubSubType>(ros_topic(robot, "cmd_vel")), RosQos{}));
      // Only the latest message counts: lost ones are not retransmitted.
      participant_.reader(participant_.topic<Odometry_PubSubType>(ros_topic(robot, "odom")),
                          RosQos{.best_effort = true}, &odometry_);
    }
  }

  void command(const hal::Twist2& twist) {
    Twist_ message;
    message.linear().x(twist.vx);
    message.linear().y(twist.vy);
    message.angular().z(twist.omega);
    for (api::DataWriter* const writer : writers_) writer->write(&message);
  }
  std::uint64_t heard() const { return odometry_.count(); }

 private:
  OdometryCounter odometry_;
  RosParticipant participant_;  // declared after the listener of its readers
  std::vector<api::DataWriter*> writers_;
};

OperatorNode::OperatorNode(const Settings& settings)
    : implementation_(std::make_unique<Implementation>(settings)) {}
OperatorNode::~OperatorNode() = default;

void OperatorNode::command(const hal::Twist2& twist) { implementation_->command(twist); }
std::uint64_t OperatorNode::heard() const { return implementation_->heard(); }

}  // namespace controllers
