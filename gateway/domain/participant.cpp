#include "gateway/domain/participant.h"

#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "gateway/domain/library_log.h"
#include "gateway/guard/filtering_transport.h"
#include "gateway/guard/handed_transport.h"
#include "gateway/guard/sending_socket.h"
#include "gateway/guard/trust.h"
#include "gateway/process/domains.h"

namespace gateway::domain {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
/// Period in which a controller that was started first looks for servers.
constexpr hal::Duration kAnnouncementPeriod = std::chrono::milliseconds{500};
/// Time after which DDS forgets a silent peer. It is long, so that a process that was stopped by a
/// debugger is still known when it continues.
constexpr hal::Duration kParticipantLease = std::chrono::hours{1};
constexpr hal::Duration kHeartbeatPeriod = std::chrono::milliseconds{20};
/// For topics that everybody reads: each heartbeat of a server goes to every controller, and each
/// controller answers.
constexpr hal::Duration kSharedHeartbeatPeriod = std::chrono::milliseconds{200};
/// Time in which a writer ignores requests for a sample that it has just sent. Longer than an
/// exchange.
constexpr hal::Duration kNackSuppression = std::chrono::milliseconds{10};
/// A reader asks a newly discovered writer for its samples repeatedly, until it hears from it. With
/// 0 there is no pause in between, and the readers of many processes then keep the writer from
/// answering (measured: 100 processes took 13 s to start).
constexpr hal::Duration kFirstAcknack = std::chrono::milliseconds{50};
constexpr std::uint32_t kSocketBuffer = 4U << 20U;

/// Called once per process, before the first participant.
void configure_library() {
  take_over_library_log();
  // Two participants in one process communicate like those in two processes, so that tests cover
  // the real path.
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
  // Without this, profiles that the user specifies (security) would be ignored.
  guard::api::DomainParticipantFactory::get_instance()->load_profiles();
}

guard::rtps::Locator_t locator_of(int port) {
  guard::rtps::Locator_t locator;
  guard::rtps::IPLocator::createLocator(LOCATOR_KIND_UDPv4, kLoopback,
                                        static_cast<std::uint32_t>(port), locator);
  return locator;
}

/// Two participants in one process must not have the same id, because it is part of their GUIDs.
int next_participant_id() {
  static std::atomic<int> next_id{process::kPlaces};
  return next_id++;
}

/// Address at which the server at a place of a domain is discovered.
guard::rtps::Locator_t discovery_locator(int domain, int place) {
  return locator_of(process::discovery_port(domain, place));
}

using TransportDescriptor = std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface>;

TransportDescriptor udp_on(const std::vector<std::string>& addresses) {
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = addresses;
  udp->sendBufferSize = kSocketBuffer;
  udp->receiveBufferSize = kSocketBuffer;
  return udp;
}

guard::api::DomainParticipantQos qos_over(
    const TransportDescriptor& transport, int participant_id,
    const std::shared_ptr<guard::DatagramFilter>& filter,
    const std::shared_ptr<guard::SendingSocket>& sender = nullptr) {
  static std::once_flag configured;
  std::call_once(configured, configure_library);

  guard::api::DomainParticipantQos qos =
      guard::api::DomainParticipantFactory::get_instance()->get_default_participant_qos();
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.assign(
      1, std::make_shared<guard::FilteringTransportDescriptor>(transport, filter, sender));
  qos.wire_protocol().participant_id = participant_id;
  return qos;
}

/// The filter of a participant in the star. @throws NoSuchUser
std::shared_ptr<guard::DatagramFilter> filter_of_star() {
  return std::make_shared<guard::DatagramFilter>(
      guard::DatagramFilter::Settings{.networks = guard::networks_of({kLoopback}),
                                      .is_star = true,
                                      .trust = guard::Trust::of_environment()});
}

/// The filter of an invited process: it accepts only the process that invited it, whoever else uses
/// that loopback interface.
std::shared_ptr<guard::DatagramFilter> filter_for(const guard::HandedSockets& handed) {
  constexpr std::uint32_t kWhole = 0xffffffff;
  return std::make_shared<guard::DatagramFilter>(guard::DatagramFilter::Settings{
      .networks = {{INADDR_LOOPBACK, kWhole}}, .is_star = true, .ports = handed.hosts});
}

void join_star(guard::api::DomainParticipantQos& qos, const guard::rtps::Locator_t& discovery) {
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(discovery);
  builtin.avoid_builtin_multicast = true;
  builtin.discovery_config.leaseDuration = guard::to_dds(kParticipantLease);
  builtin.discovery_config.leaseDuration_announcementperiod = guard::to_dds(kAnnouncementPeriod);
}

/// A random GUID prefix. Fast DDS derives GUIDs from the addresses of a host, which can be the same
/// in another network namespace, and from the pid in the process's own namespace.
guard::rtps::GuidPrefix_t random_prefix() {
  guard::rtps::GuidPrefix_t prefix;
  if (getrandom(prefix.value, sizeof(prefix.value), 0) != sizeof(prefix.value)) {
    throw std::runtime_error("no random numbers");
  }
  const std::array<guard::rtps::octet, 2> vendor = {0x01, 0x0f};  // eProsima (DDSI-RTPS vendor ids)
  std::ranges::copy(vendor, prefix.value);
  return prefix;
}

template <class Qos>
void set_common_qos(Qos& qos, Presence presence, std::int32_t max_instances) {
  qos.reliability().kind = guard::api::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = guard::api::TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.history().kind = guard::api::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 1;
  qos.resource_limits().max_instances = max_instances;
  qos.resource_limits().max_samples_per_instance = 1;
  qos.resource_limits().max_samples = max_instances;
  qos.resource_limits().allocated_samples = 4;
  qos.endpoint().history_memory_policy = guard::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  if (presence == Presence::kIgnored) return;
  qos.liveliness().kind = guard::api::AUTOMATIC_LIVELINESS_QOS;
  qos.liveliness().lease_duration = guard::to_dds(kLivelinessLease);
  qos.liveliness().announcement_period = guard::to_dds(kLivelinessPeriod);
}

}  // namespace

Participant Participant::server(int domain, int place) {
  const auto filter = filter_of_star();
  const auto sender = std::make_shared<guard::SendingSocket>();
  guard::api::DomainParticipantQos qos = qos_over(udp_on({kLoopback}), place, filter, sender);
  join_star(qos, discovery_locator(domain, place));
  qos.name("baraka server");
  Participant made(domain, qos, filter);
  made.port_ = sender->port();
  return made;
}

Participant Participant::controller(int domain, const guard::HandedSockets* handed) {
  const auto filter = handed != nullptr ? filter_for(*handed) : filter_of_star();
  const TransportDescriptor transport =
      handed != nullptr ? std::make_shared<guard::HandedTransportDescriptor>(*handed, kSocketBuffer)
                        : udp_on({kLoopback});
  const auto sender = handed != nullptr ? nullptr : std::make_shared<guard::SendingSocket>();
  guard::api::DomainParticipantQos qos = qos_over(transport, next_participant_id(), filter, sender);
  if (handed != nullptr) qos.wire_protocol().prefix = random_prefix();
  // Any free ports: the ports of the participant ids of a domain would suffice for only 112
  // controllers.
  join_star(qos, locator_of(handed != nullptr ? handed->metatraffic.port : process::free_port()));
  qos.wire_protocol().default_unicast_locator_list.push_back(
      locator_of(handed != nullptr ? handed->data.port : process::free_port()));
  qos.name("baraka controller");
  auto& builtin = qos.wire_protocol().builtin;
  for (int place = 0; place < process::kPlaces; ++place) {
    builtin.initialPeersList.push_back(discovery_locator(domain, place));
  }
  builtin.discovery_config.initial_announcements.count = 20;
  builtin.discovery_config.initial_announcements.period =
      guard::to_dds(std::chrono::milliseconds{20});
  return {domain, qos, filter};
}

Participant Participant::inspection(int domain, const std::vector<std::string>& addresses,
                                    const std::string& name,
                                    guard::api::DomainParticipantListener* listener) {
  // Not on the ports of the servers' places, where controllers would discover it.
  const auto filter = std::make_shared<guard::DatagramFilter>(
      guard::DatagramFilter::Settings{.networks = guard::networks_of(addresses), .is_star = false});
  guard::api::DomainParticipantQos qos = qos_over(udp_on(addresses), next_participant_id(), filter);
  qos.name(name);
  return {domain, qos, filter, listener};
}

Participant::Participant(int domain, const guard::api::DomainParticipantQos& qos,
                         std::shared_ptr<guard::DatagramFilter> filter,
                         guard::api::DomainParticipantListener* listener)
    : filter_(std::move(filter)),
      participant_(guard::api::DomainParticipantFactory::get_instance()->create_participant(
          static_cast<std::uint32_t>(domain), qos, listener, guard::api::StatusMask::none())) {
  if (participant_ == nullptr) {
    throw std::runtime_error(
        fmt::format("Fast DDS cannot join domain {}: is another program on its ports?{}", domain,
                    last_words_of_library()));
  }
  publisher_ = participant_->create_publisher(guard::api::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(guard::api::SUBSCRIBER_QOS_DEFAULT);
  if (publisher_ == nullptr || subscriber_ == nullptr) {
    throw std::runtime_error("Fast DDS makes no publisher or subscriber" + last_words_of_library());
  }
}

Participant::Participant(Participant&& other) noexcept
    : filter_(std::move(other.filter_)),
      participant_(std::exchange(other.participant_, nullptr)),
      publisher_(other.publisher_),
      subscriber_(other.subscriber_),
      port_(other.port_) {}

Participant::~Participant() {
  if (participant_ == nullptr) return;
  participant_->delete_contained_entities();
  guard::api::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

guard::api::Topic* Participant::add_topic(const std::string& name,
                                          const guard::api::TypeSupport& type) {
  // A peer of this version crashes when it receives a type with a sequence of structures.
  type->auto_fill_type_object(false);
  type->auto_fill_type_information(false);
  guard::api::Topic* topic = nullptr;
  if (guard::is_ok(type.register_type(participant_))) {
    topic = participant_->create_topic(name, type.get_type_name(), guard::api::TOPIC_QOS_DEFAULT);
  }
  if (topic == nullptr) throw std::runtime_error("Fast DDS makes no topic " + name);
  return topic;
}

/// Fast DDS 2.9 returns the changes of a writer to their pool, which takes their numbers, before it
/// ends the writer's heartbeats: one that comes in between fills the gap from there to the next
/// number, which takes hours, and the destructor waits for it.
void Participant::remove_writer(guard::api::DataWriter* writer) {
  std::size_t removed = 0;
  writer->clear_history(&removed);
  publisher_->delete_datawriter(writer);
}

void Participant::remove_topic(guard::api::Topic* topic) { participant_->delete_topic(topic); }

guard::api::DataWriterQos writer_qos(Presence presence) {
  guard::api::DataWriterQos qos = guard::api::DATAWRITER_QOS_DEFAULT;
  set_common_qos(qos, presence, kMaxWritten);
  qos.publish_mode().kind = guard::api::SYNCHRONOUS_PUBLISH_MODE;
  // Otherwise, with every sample a heartbeat and the end of NACK suppression (0 by default) would
  // each wake up the timer threads: measured 13 context switches and 120 us per exchange, without
  // them 6 and 72 us.
  qos.reliable_writer_qos().disable_heartbeat_piggyback = true;
  qos.reliable_writer_qos().times.nackSupressionDuration = guard::to_dds(kNackSuppression);
  qos.reliable_writer_qos().times.initialHeartbeatDelay = guard::to_dds(hal::Duration::zero());
  qos.reliable_writer_qos().times.heartbeatPeriod =
      guard::to_dds(presence == Presence::kWatched ? kSharedHeartbeatPeriod : kHeartbeatPeriod);
  qos.reliable_writer_qos().times.nackResponseDelay = guard::to_dds(hal::Duration::zero());
  return qos;
}

guard::api::DataReaderQos reader_qos(Presence presence) {
  guard::api::DataReaderQos qos = guard::api::DATAREADER_QOS_DEFAULT;
  set_common_qos(qos, presence, kMaxRead);
  qos.reliable_reader_qos().times.initialAcknackDelay = guard::to_dds(kFirstAcknack);
  qos.reliable_reader_qos().times.heartbeatResponseDelay = guard::to_dds(hal::Duration::zero());
  return qos;
}

}  // namespace gateway::domain
