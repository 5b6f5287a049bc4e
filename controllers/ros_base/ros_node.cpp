#include "controllers/ros_base/ros_node.h"

#include <arpa/inet.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <array>
#include <chrono>
#include <exception>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>

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

/// rmw_qos_profile_default of ROS 2 for commands and odometry; tf2_ros's for transforms.
constexpr int kDepth = 10, kDepthOfTransforms = 100;

/// @throws std::runtime_error
std::string address_of(const std::string& interface) {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) throw std::runtime_error("cannot list network interfaces");
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(all, freeifaddrs);
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if (interface != one->ifa_name) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr, text.data(),
              text.size());
    return text.data();
  }
  throw std::runtime_error("no network interface '" + interface + "' with an IPv4 address");
}

/// What cannot be decoded is dropped: the generated code lets some of what Fast CDR throws through,
/// and that would be the end of the program.
template <class Generated>
class Guarded final : public Generated {
 public:
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    try {
      return Generated::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

template <class Entity>
Entity* made(Entity* entity, const std::string& what) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS makes no " + what);
  return entity;
}

template <class Qos>
void set_history(Qos& qos, int depth) {
  qos.history().kind = api::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth;
  qos.durability().kind = api::VOLATILE_DURABILITY_QOS;
  qos.data_sharing().off();  // it would go past the air
}

api::DataWriterQos writer_qos(int depth) {
  api::DataWriterQos qos = api::DATAWRITER_QOS_DEFAULT;
  set_history(qos, depth);
  qos.reliability().kind = api::RELIABLE_RELIABILITY_QOS;
  // On a thread of DDS: a card that is busy may hold it up, and not the controller.
  qos.publish_mode().kind = api::ASYNCHRONOUS_PUBLISH_MODE;
  return qos;
}

api::DataReaderQos reader_qos(bool best_effort) {
  api::DataReaderQos qos = api::DATAREADER_QOS_DEFAULT;
  set_history(qos, kDepth);
  qos.reliability().kind =
      best_effort ? api::BEST_EFFORT_RELIABILITY_QOS : api::RELIABLE_RELIABILITY_QOS;
  return qos;
}

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
  explicit Implementation(const Settings& settings) : settings_(settings) {
    api::DomainParticipantFactory& factory = *api::DomainParticipantFactory::get_instance();
    factory.load_profiles();  // else what the user says there would not count
    api::DomainParticipantQos qos = factory.get_default_participant_qos();
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {address_of(settings.interface)};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.assign(1, udp);
    qos.name("ros_base");
    participant_ = made(
        factory.create_participant(static_cast<std::uint32_t>(settings.domain), qos),
        "participant in domain " + std::to_string(settings.domain) + " on " + settings.interface);
    try {
      make_endpoints();
    } catch (...) {
      close();
      throw;
    }
  }
  ~Implementation() { close(); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  Commands take_commands() { return commands_.take(); }

  void publish(const hal::Odometry& odometry) {
    const auto stamp = stamp_now();
    publish_odometry(odometry, stamp);
    publish_transform(odometry.pose, stamp);
  }

 private:
  using Stamp = builtin_interfaces::msg::dds_::Time_;

  void make_endpoints() {
    publisher_ = made(participant_->create_publisher(api::PUBLISHER_QOS_DEFAULT), "publisher");
    subscriber_ = made(participant_->create_subscriber(api::SUBSCRIBER_QOS_DEFAULT), "subscriber");
    odometry_ =
        made(publisher_->create_datawriter(topic<Odometry_PubSubType>("odom"), writer_qos(kDepth)),
             "writer of odom");
    // Transforms of all robots share a topic: their frames tell them apart.
    transforms_ = made(publisher_->create_datawriter(topic<TFMessage_PubSubType>("tf"),
                                                     writer_qos(kDepthOfTransforms)),
                       "writer of tf");
    made(subscriber_->create_datareader(topic<Twist_PubSubType>("cmd_vel"),
                                        reader_qos(settings_.best_effort), &commands_),
         "reader of cmd_vel");
  }

  template <class Generated>
  api::Topic* topic(const std::string& name) {
    const api::TypeSupport type(new Guarded<Generated>());
    // A peer of this version crashes when it is told a type with a sequence of structures.
    type->auto_fill_type_object(false);
    type->auto_fill_type_information(false);
    type.register_type(participant_);
    const bool is_shared = name == "tf" || settings_.name_space.empty();
    const std::string full = "rt/" + (is_shared ? name : settings_.name_space + "/" + name);
    return made(participant_->create_topic(full, type.get_type_name(), api::TOPIC_QOS_DEFAULT),
                "topic " + full);
  }

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

  void close() {
    participant_->delete_contained_entities();
    api::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  const Settings settings_;
  CommandBox commands_;
  api::DomainParticipant* participant_ = nullptr;
  api::Publisher* publisher_ = nullptr;
  api::Subscriber* subscriber_ = nullptr;
  api::DataWriter* odometry_ = nullptr;
  api::DataWriter* transforms_ = nullptr;
};

RosNode::RosNode(const Settings& settings)
    : implementation_(std::make_unique<Implementation>(settings)) {}
RosNode::~RosNode() = default;

RosNode::Commands RosNode::take_commands() { return implementation_->take_commands(); }
void RosNode::publish(const hal::Odometry& odometry) { implementation_->publish(odometry); }

}  // namespace controllers
