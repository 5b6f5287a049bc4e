#include "controllers/ros/ros_participant.h"

#include <arpa/inet.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <array>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <memory>

namespace controllers {
namespace {

namespace api = eprosima::fastdds::dds;

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

template <class Entity>
Entity* made(Entity* entity, const std::string& what) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS makes no " + what);
  return entity;
}

template <class Qos>
void set(Qos& qos, const RosQos& ros) {
  qos.history().kind = api::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = ros.depth;
  qos.durability().kind =
      ros.transient_local ? api::TRANSIENT_LOCAL_DURABILITY_QOS : api::VOLATILE_DURABILITY_QOS;
  qos.reliability().kind =
      ros.best_effort ? api::BEST_EFFORT_RELIABILITY_QOS : api::RELIABLE_RELIABILITY_QOS;
  qos.data_sharing().off();  // it would bypass the radio
}

}  // namespace

RosParticipant::RosParticipant(const Settings& settings) {
  api::DomainParticipantFactory& factory = *api::DomainParticipantFactory::get_instance();
  factory.load_profiles();  // otherwise the user's profiles would be ignored
  api::DomainParticipantQos qos = factory.get_default_participant_qos();
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {address_of(settings.interface)};
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.assign(1, udp);
  qos.name(settings.name);
  if (!settings.user_data.empty())
    qos.user_data().setValue({settings.user_data.begin(), settings.user_data.end()});
  participant_ = made(
      factory.create_participant(static_cast<std::uint32_t>(settings.domain), qos),
      "participant in domain " + std::to_string(settings.domain) + " on " + settings.interface);
  try {
    publisher_ = made(participant_->create_publisher(api::PUBLISHER_QOS_DEFAULT), "publisher");
    subscriber_ = made(participant_->create_subscriber(api::SUBSCRIBER_QOS_DEFAULT), "subscriber");
  } catch (...) {
    close();
    throw;
  }
}

RosParticipant::~RosParticipant() { close(); }

void RosParticipant::close() {
  participant_->delete_contained_entities();
  api::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

api::Topic* RosParticipant::registered(const std::string& name, const std::string& type) {
  return made(participant_->create_topic(name, type, api::TOPIC_QOS_DEFAULT), "topic " + name);
}

api::DataWriter* RosParticipant::writer(api::Topic* topic, const RosQos& ros) {
  api::DataWriterQos qos = api::DATAWRITER_QOS_DEFAULT;
  set(qos, ros);
  // On a thread of DDS, so that a busy network card does not block the controller.
  qos.publish_mode().kind = api::ASYNCHRONOUS_PUBLISH_MODE;
  return made(publisher_->create_datawriter(topic, qos), "writer of " + topic->get_name());
}

api::DataReader* RosParticipant::reader(api::Topic* topic, const RosQos& ros,
                                        api::DataReaderListener* listener) {
  api::DataReaderQos qos = api::DATAREADER_QOS_DEFAULT;
  set(qos, ros);
  return made(subscriber_->create_datareader(topic, qos, listener),
              "reader of " + topic->get_name());
}

}  // namespace controllers
