#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/dds/datagram_filter.h"
#include "hal/dds/fastdds.h"
#include "hal/dds/handed_sockets.h"
#include "hal/types/time.h"

namespace hal::dds {

/// This process's place in a DDS domain: UDP on 127.0.0.1, no multicast, discovery in the form of
/// a star. Servers sit on the ports of the participant ids 0..7; controllers sit on any others and
/// announce themselves to those eight. So controllers never meet each other, which keeps the
/// effort of discovery linear in their number.
///
/// In the star each speaks from a SendingSocket and hears whom BARAKA_TRUST lets it (Trust), as the
/// kernel tells whose ports are; who was handed its sockets hears who handed them.
class Participant {
 public:
  /// @param place  0..7.
  /// @throws std::runtime_error  if DDS cannot be opened, e.g. because the port is taken.
  /// @throws NoSuchUser  of BARAKA_TRUST; controller() likewise.
  static Participant server(int domain, int place);
  /// @param handed  what it is to speak by, and to nobody but whom, in another network namespace;
  ///   outlives it. Null: sockets of its own.
  static Participant controller(int domain, const HandedSockets* handed = nullptr);
  /// Outside the star: ordinary discovery by multicast, for standard tools.
  /// @param addresses  IPv4, of the interfaces to use.  @param name  for people.
  /// @param listener  hears of the endpoints of others; may be null.
  /// @throws std::runtime_error
  static Participant inspection(int domain, const std::vector<std::string>& addresses,
                                const std::string& name,
                                api::DomainParticipantListener* listener = nullptr);
  ~Participant();
  Participant(Participant&& other) noexcept;
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  Participant& operator=(Participant&&) = delete;

  /// A topic of a type; no two endpoints of a participant share one.
  /// @throws std::runtime_error
  api::Topic* add_topic(const std::string& name, const api::TypeSupport& type);
  void remove_topic(api::Topic* topic);

  /// What comes in passes it.
  DatagramFilter& filter() { return *filter_; }
  const DatagramFilter& filter() const { return *filter_; }

  /// The UDP port that a server() speaks from.
  std::uint16_t port() const { return port_; }

  api::Publisher& publisher() { return *publisher_; }
  api::Subscriber& subscriber() { return *subscriber_; }

 private:
  Participant(int domain, const api::DomainParticipantQos& qos,
              std::shared_ptr<DatagramFilter> filter,
              api::DomainParticipantListener* listener = nullptr);

  std::shared_ptr<DatagramFilter> filter_;
  api::DomainParticipant* participant_;
  api::Publisher* publisher_;
  api::Subscriber* subscriber_;
  std::uint16_t port_ = 0;
};

/// Longest silence of a process on another host before it counts as dead, and how often it is
/// heard. On the same host ProcessWatch decides.
inline constexpr Duration kLivelinessLease = std::chrono::milliseconds{1500};
inline constexpr Duration kLivelinessPeriod = std::chrono::milliseconds{300};

/// Samples that wait for whoever reads them here.
inline constexpr std::int32_t kMaxInstances = 4096;
/// Most writers' last samples that a reader of DDS keeps. Those whose writers are gone make room;
/// those behind a lost one do not, which a participant that is not heard any more never repairs.
inline constexpr std::int32_t kMaxRead = 1 << 16;
/// The same of a writer. Those that were disposed of stay until every reader knows, also those of
/// processes that were killed, which DDS forgets late.
inline constexpr std::int32_t kMaxWritten = 1 << 20;

/// Whether the readers of a topic notice the silence of its writers. Not for what is written often:
/// every sample would wake up the thread that keeps the time of the lease (measured: 3 of 13
/// context switches per exchange).
enum class Presence { kWatched, kIgnored };

/// The settings of every endpoint; each of them was measured to matter.
api::DataWriterQos writer_qos(Presence presence);
api::DataReaderQos reader_qos(Presence presence);

}  // namespace hal::dds
