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

#include "gateway/guard/trust.h"
#include "gateway/guard/udp_sender.h"
#include "gateway/process/waiting.h"
#include "hal/rtps/cursor.h"
#include "hal/rtps/entity_id.h"
#include "hal/rtps/walk.h"
#include "hal/types/time.h"

namespace gateway::guard {

class Strangers;

/// The addresses that an interface reaches without a router.
struct Network {
  std::uint32_t address = 0, mask = 0;
  bool holds(std::uint32_t other) const { return (address & mask) == (other & mask); }
};

/// The networks of the interfaces of this host that have one of the addresses: 127.0.0.0/8 for
/// 127.0.0.1. In addition each address of this host as a network of one address, because programs
/// here may send from any of them and programs elsewhere cannot (Linux drops arriving packets with
/// its own source addresses). An address that no interface has is a network of one address, too.
std::vector<Network> networks_of(const std::vector<std::string>& addresses);

/// Decides which datagrams reach a participant of Fast DDS. Fast DDS 2.9 of Debian 12 uses lengths
/// without checking them (CVE-2024-28231 and others), so datagrams that hal/rtps rejects are
/// dropped. Datagrams from beyond the participant's own interfaces are dropped, too: Linux delivers
/// a datagram of a multicast group to every socket on its port, whichever interface the socket has
/// joined the group on (ip(7), IP_MULTICAST_ALL), so a LAN would reach participants of 127.0.0.1.
///
/// On the loopback interface it also ties a participant to its source port, which no other program
/// can have at the same time, because any program could use its GUID. The port may change once the
/// old one is closed. The user of a port is looked up when the port is first heard: no data of an
/// untrusted user reaches Fast DDS, and the user is reported (Strangers).
///
/// Dropped datagrams are counted by reason and source address; the first of an address is logged,
/// and their number at the end. Any thread.
class DatagramFilter {
 public:
  struct Settings {
    std::vector<Network> networks;
    /// Whether each participant sends from one port and only for itself: true in the star of the
    /// exchange, whose programs are all of this project. Others may use several ports, and relay
    /// discovery.
    bool is_star = false;
    std::vector<std::uint16_t> ports{};         ///< The only accepted source ports; empty: any.
    std::optional<Trust> trust{};               ///< In a star: accepted users; none: all.
    hal::Clock& clock = process::wall_clock();  ///< Outlives the filter.
  };
  explicit DatagramFilter(Settings settings);
  ~DatagramFilter();  ///< Logs how many were dropped, if any.
  DatagramFilter(const DatagramFilter&) = delete;
  DatagramFilter& operator=(const DatagramFilter&) = delete;

  /// Whether to accept the datagram.
  bool lets_in(hal::rtps::Octets datagram, const UdpSender& sender);

  /// Rejects all further datagrams of a participant.
  void ignore(const hal::rtps::GuidPrefix& participant);

  /// Source port of a participant; nullopt if it was not heard recently, or not in a star.
  std::optional<UdpSender> sender_of(const hal::rtps::GuidPrefix& participant) const;

  /// Time since the last accepted datagram of a participant; nullopt if there was none recently.
  std::optional<hal::Duration> silence_of(const hal::rtps::GuidPrefix& participant) const;

  /// Accepted users; null: all.
  const Trust* trust() const { return settings_.trust ? &*settings_.trust : nullptr; }

  /// "3 datagrams from 127.0.0.1:7660 and others: 2 DATA: its payload is too short; 1 header: …";
  /// empty if there were none.
  std::string drops() const;

  /// One line for each refused user: see Strangers::summary().
  std::vector<std::string> strangers() const;

 private:
  struct Speaker {
    UdpSender sender;
    std::uint64_t heard = 0;   ///< Number of its latest datagram.
    hal::Time heard_at{};      ///< Time of its latest datagram.
    std::int64_t highest = 0;  ///< Highest of its sequence numbers.
    bool is_ignored = false;
  };
  /// Why a datagram is rejected, and because of which part; empty: it is accepted.
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
  std::unique_ptr<Strangers> strangers_;  ///< Null: all users are accepted.
  mutable std::mutex mutex_;
  std::map<hal::rtps::GuidPrefix, Speaker> speakers_;
  std::uint64_t heard_ = 0;
  std::map<Reason, std::uint64_t> drops_;
  /// First sender of each address from which something was dropped.
  std::vector<UdpSender> named_;
};

}  // namespace gateway::guard
