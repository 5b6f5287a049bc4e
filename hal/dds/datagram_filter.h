#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/dds/trust.h"
#include "hal/dds/udp_sender.h"
#include "hal/dds/waiting.h"
#include "hal/rtps/cursor.h"
#include "hal/rtps/entity_id.h"
#include "hal/rtps/walk.h"
#include "hal/types/time.h"

namespace hal::dds {

class Strangers;

/// The addresses from which an interface is reached without a router.
struct Network {
  std::uint32_t address = 0, mask = 0;
  bool holds(std::uint32_t other) const { return (address & mask) == (other & mask); }
};

/// The networks of those interfaces of this host that have one of the addresses: 127.0.0.0/8 for
/// 127.0.0.1; then each address of this host by itself, as programs here may speak from any, and
/// nobody beyond can (Linux drops what comes in from its own addresses). An address that no
/// interface has is a network by itself, too.
std::vector<Network> networks_of(const std::vector<std::string>& addresses);

/// Which datagrams a participant looks at. Fast DDS 2.9 as Debian 12 has it follows lengths that it
/// has not checked (CVE-2024-28231 and others), so nothing that hal/rtps refuses gets there; nor
/// does what comes from beyond the participant's own interfaces: Linux hands a datagram of a
/// multicast group to every socket on its port, whichever interface the socket has joined the group
/// on (ip(7), IP_MULTICAST_ALL), so that a LAN reached participants of 127.0.0.1.
///
/// On the loopback interface it also binds a participant to the port it speaks from, which no other
/// program can have meanwhile: its GUID alone could be anyone's. The port may change once nobody
/// has the old one. Whose the port is, is looked up when it is heard first: nothing of a user who
/// is not trusted gets to Fast DDS, and that user is named (Strangers).
///
/// What is dropped is counted by reason and sender's address; the first of an address is logged,
/// and at the end how many there were. Any thread.
class DatagramFilter {
 public:
  struct Settings {
    std::vector<Network> networks;
    /// Whether everybody speaks for himself from one port: in the star of the exchange, where all
    /// are of this project. Others may use several ports, and relay discovery.
    bool is_star = false;
    std::vector<std::uint16_t> ports{};  ///< The only ones that are listened to; empty: any.
    std::optional<Trust> trust{};        ///< Of a star: which users are heard; none: all.
    Clock& clock = wall_clock();         ///< Outlives the filter.
  };
  explicit DatagramFilter(Settings settings);
  ~DatagramFilter();  ///< Logs how many were dropped, if any.
  DatagramFilter(const DatagramFilter&) = delete;
  DatagramFilter& operator=(const DatagramFilter&) = delete;

  /// Whether to hand the datagram on.
  bool lets_in(hal::rtps::Octets datagram, const UdpSender& sender);

  /// From now on nothing of a participant is let in.
  void ignore(const hal::rtps::GuidPrefix& participant);

  /// Where a participant speaks from; none if it was not heard lately, or not in a star.
  std::optional<UdpSender> sender_of(const hal::rtps::GuidPrefix& participant) const;

  /// How long nothing was let in of a participant; none if it was never heard, or not lately.
  std::optional<Duration> silence_of(const hal::rtps::GuidPrefix& participant) const;

  /// Which users are heard; null: all.
  const Trust* trust() const { return settings_.trust ? &*settings_.trust : nullptr; }

  /// "3 datagrams from 127.0.0.1:7660 and others: 2 DATA: its payload is too short; 1 header: …";
  /// empty if there were none.
  std::string drops() const;

  /// One line of each user who was not heard: see Strangers::summary().
  std::vector<std::string> strangers() const;

 private:
  struct Speaker {
    UdpSender sender;
    std::uint64_t heard = 0;   ///< Number of the datagram it was heard with last …
    Time heard_at{};           ///< … and when that was.
    std::int64_t highest = 0;  ///< Of its sequence numbers.
    bool is_ignored = false;
  };
  /// Part of a datagram and what is wrong with it; empty: nothing.
  struct Reason {
    std::string_view part, what;
    auto operator<=>(const Reason&) const = default;
  };

  bool is_near(std::uint32_t address) const;
  bool is_of_stranger(const hal::rtps::GuidPrefix& source, hal::rtps::Octets datagram,
                      const UdpSender& sender);
  Reason objection_to(const hal::rtps::Walk& walk, const UdpSender& sender) const;
  Reason objection_to(const hal::rtps::GuidPrefix& source, hal::rtps::Octets datagram,
                      const UdpSender& sender);
  void meet(const hal::rtps::GuidPrefix& participant, const Speaker& speaker);
  void drop(const Reason& reason, const UdpSender& sender);

  const Settings settings_;
  std::unique_ptr<Strangers> strangers_;  ///< Null: all users are heard.
  mutable std::mutex mutex_;
  std::map<hal::rtps::GuidPrefix, Speaker> speakers_;
  std::uint64_t heard_ = 0;
  std::map<Reason, std::uint64_t> drops_;
  std::vector<UdpSender> named_;  ///< The first of each address that something was dropped from.
};

}  // namespace hal::dds
