#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gateway/guard/datagram_filter.h"
#include "gateway/guard/fastdds.h"
#include "gateway/guard/handed_sockets.h"
#include "hal/types/time.h"

namespace gateway::domain {

/// This process's participant in a DDS domain: UDP on 127.0.0.1, no multicast, discovery in the
/// form of a star. Servers use the ports of the participant ids 0..7; controllers use any others
/// and announce themselves to those eight. Controllers therefore never discover each other, which
/// keeps the effort of discovery linear in their number.
///
/// In the star each participant sends from a SendingSocket and accepts data of the users that Trust
/// permits, as the kernel tells the user of a port. A participant with passed sockets accepts data
/// of the process that passed them.
class Participant {
 public:
  /// @param place  0..7.
  /// @throws std::runtime_error  if DDS cannot be opened, e.g. because the port is taken.
  /// @throws NoSuchUser  of BARAKA_TRUST; controller() likewise.
  static Participant server(int domain, int place);
  /// @param handed  sockets of another network namespace, with the only process to communicate
  /// with; outlives it. Null: the participant opens its own sockets.
  static Participant controller(int domain, const guard::HandedSockets* handed = nullptr);
  /// Outside the star: ordinary discovery by multicast, for standard tools.
  /// @param addresses  IPv4 addresses of the interfaces to use.
  /// @param name  name of the participant, for display.
  /// @param listener  notified of the endpoints of others; may be null.
  /// @throws std::runtime_error  as server().
  static Participant inspection(int domain, const std::vector<std::string>& addresses,
                                const std::string& name,
                                guard::api::DomainParticipantListener* listener = nullptr);
  ~Participant();
  Participant(Participant&& other) noexcept;
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  Participant& operator=(Participant&&) = delete;

  /// Creates a topic of a type; no two endpoints of a participant share one.
  /// @throws std::runtime_error  Fast DDS refuses the type or the topic.
  guard::api::Topic* add_topic(const std::string& name, const guard::api::TypeSupport& type);
  void remove_topic(guard::api::Topic* topic);
  /// Deletes a writer of publisher().
  void remove_writer(guard::api::DataWriter* writer);

  /// The filter of received datagrams.
  guard::DatagramFilter& filter() { return *filter_; }
  const guard::DatagramFilter& filter() const { return *filter_; }

  /// The UDP port from which a server() sends.
  std::uint16_t port() const { return port_; }

  guard::api::Publisher& publisher() { return *publisher_; }
  guard::api::Subscriber& subscriber() { return *subscriber_; }

 private:
  Participant(int domain, const guard::api::DomainParticipantQos& qos,
              std::shared_ptr<guard::DatagramFilter> filter,
              guard::api::DomainParticipantListener* listener = nullptr);

  std::shared_ptr<guard::DatagramFilter> filter_;
  guard::api::DomainParticipant* participant_;
  guard::api::Publisher* publisher_;
  guard::api::Subscriber* subscriber_;
  std::uint16_t port_ = 0;
};

/// Longest silence of a process on another host before it counts as dead, and the period of its
/// announcements. On the same host ProcessWatch decides.
inline constexpr hal::Duration kLivelinessLease = std::chrono::milliseconds{1500};
inline constexpr hal::Duration kLivelinessPeriod = std::chrono::milliseconds{300};

/// Maximum number of samples that wait for a reader in this process.
inline constexpr std::int32_t kMaxInstances = 4096;
/// Maximum number of writers whose last samples a DDS reader keeps. Samples of writers that have
/// left are removed if there is no room. Samples that follow a lost one are not removed if their
/// participant is no longer heard, because the loss is never repaired.
inline constexpr std::int32_t kMaxRead = 1 << 16;
/// The same for a writer. Disposed instances are kept until every reader knows about it, including
/// readers in killed processes, which DDS forgets late.
inline constexpr std::int32_t kMaxWritten = 1 << 20;

/// Whether the readers of a topic notice that its writers are silent. Not for topics that are
/// written often: every sample would wake up the thread that watches the lease (measured: 3 of 13
/// context switches per exchange).
enum class Presence { kWatched, kIgnored };

/// The settings of every endpoint; each of them was measured to matter.
guard::api::DataWriterQos writer_qos(Presence presence);
guard::api::DataReaderQos reader_qos(Presence presence);

}  // namespace gateway::domain
