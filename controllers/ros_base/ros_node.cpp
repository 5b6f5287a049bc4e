#include "controllers/ros_base/ros_node.h"

#include <chrono>
#include <map>

#include "controllers/ros/ros_parameters.h"
#include "controllers/ros/ros_participant.h"
#include "controllers/ros_base/base_topics.h"
#include "controllers/ros_base/command_box.h"
#include "controllers/ros_base/discovery_info.h"
#include "idl/ros/values.h"
#include "inspectPubSubTypes.h"
#include "ros_nodesPubSubTypes.h"

namespace controllers {
namespace {

namespace api = eprosima::fastdds::dds;
using geometry_msgs::msg::dds_::Twist_;
using geometry_msgs::msg::dds_::Twist_PubSubType;
using geometry_msgs::msg::dds_::TwistStamped_;
using geometry_msgs::msg::dds_::TwistStamped_PubSubType;

constexpr std::string_view kEntitiesTopic = "ros_discovery_info";

RosNode::Stamp stamp_of_process() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  RosNode::Stamp stamp;
  stamp.sec(static_cast<std::int32_t>(seconds.count()));
  stamp.nanosec(static_cast<std::uint32_t>(std::chrono::nanoseconds(now - seconds).count()));
  return stamp;
}

/// DDS name of a topic after the user's remaps. That of the middleware itself is not ROS's.
std::string dds_name(const BaseSettings& settings, const BaseTopic& topic) {
  if (topic.name.empty()) return std::string(topic.key);
  const auto remap = settings.remaps.find(std::string(topic.name));
  return ros_topic_name(settings.name_space,
                        remap == settings.remaps.end() ? std::string(topic.name) : remap->second);
}

}  // namespace

class RosNode::Implementation {
 public:
  Implementation(const std::string& interface, const BaseSettings& settings)
      : use_sim_time_(settings.use_sim_time),
        participant_({.interface = interface,
                      .domain = settings.domain,
                      .name = kName,
                      .user_data = settings.topics.contains(std::string(kEntitiesTopic))
                                       ? enclave_user_data()
                                       : ""}) {
    for (const BaseTopic& topic : base_topics()) {
      if (settings.topics.contains(std::string(topic.key))) make_writer(settings, topic);
    }
    read_commands(settings);
    announce(settings.name_space);
  }

  Commands take_commands() { return commands_.take(); }
  bool offers(std::string_view topic) const { return writers_.contains(topic); }
  void write(std::string_view topic, void* message) {
    const auto found = writers_.find(topic);
    if (found != writers_.end()) found->second->write(message);
  }
  Stamp stamp(hal::Time now) const {
    return use_sim_time_ ? idl::ros::to_ros(now) : stamp_of_process();
  }

 private:
  void make_writer(const BaseSettings& settings, const BaseTopic& topic) {
    RosQos qos = topic.qos;
    qos.best_effort = settings.best_effort_topics.contains(std::string(topic.key));
    api::Topic* const dds = (participant_.*topic.make)(dds_name(settings, topic));
    writers_[topic.key] = participant_.writer(dds, qos);
  }

  void read_commands(const BaseSettings& settings) {
    const auto remap = settings.remaps.find(std::string(kCommandTopic));
    const std::string name =
        ros_topic_name(settings.name_space,
                       remap == settings.remaps.end() ? std::string(kCommandTopic) : remap->second);
    const RosQos qos{.best_effort = settings.best_effort_commands};
    reader_ =
        settings.use_stamped_vel
            ? participant_.reader(participant_.topic<TwistStamped_PubSubType>(name), qos, &stamped_)
            : participant_.reader(participant_.topic<Twist_PubSubType>(name), qos, &plain_);
  }

  void announce(const std::string& name_space) {
    if (!offers(kEntitiesTopic)) return;
    NodeEntities node{name_space, kName, {reader_->guid()}, {}};
    for (const auto& [key, writer] : writers_) {
      if (key != kEntitiesTopic) node.writers.push_back(writer->guid());
    }
    auto info = discovery_info(participant_.guid(), node);
    write(kEntitiesTopic, &info);
  }

  const bool use_sim_time_;
  CommandBox commands_;
  CommandListener<Twist_> plain_{commands_};
  CommandListener<TwistStamped_> stamped_{commands_};
  RosParticipant participant_;  // declared after the listeners of its readers
  std::map<std::string_view, api::DataWriter*> writers_;
  api::DataReader* reader_ = nullptr;
};

RosNode::RosNode(const std::string& interface, const BaseSettings& settings)
    : implementation_(std::make_unique<Implementation>(interface, settings)) {}
RosNode::~RosNode() = default;

RosNode::Commands RosNode::take_commands() { return implementation_->take_commands(); }
bool RosNode::offers(std::string_view topic) const { return implementation_->offers(topic); }
RosNode::Stamp RosNode::stamp(hal::Time now) const { return implementation_->stamp(now); }
void RosNode::write_raw(std::string_view topic, void* message) {
  implementation_->write(topic, message);
}

}  // namespace controllers
