#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"

namespace hal::node::routing {

/// A destination sequence number of AODV; it wraps around.
using AodvSequence = std::uint32_t;

/// Whether `a` is newer than `b`: by signed 32-bit arithmetic (RFC 3561, section 6.1).
constexpr bool is_newer(AodvSequence a, AodvSequence b) {
  return static_cast<std::int32_t>(a - b) > 0;
}

/// Route request (RFC 3561, section 5.1).
struct Rreq {
  /// 'G': a node that answers for the destination must inform the destination.
  bool gratuitous = false;
  bool destination_only = false;  ///< 'D': only the destination may answer.
  std::uint8_t hops = 0;          ///< From the originator to the transmitter.
  std::uint32_t id = 0;           ///< With the originator's address, identifies the request.
  AgentId destination;
  /// The newest known to the originator; nullopt: flag 'U'.
  std::optional<AodvSequence> destination_sequence{};
  AgentId originator{};
  AodvSequence originator_sequence = 0;
  bool operator==(const Rreq&) const = default;
};

/// Route reply (section 5.2). A hello (section 6.9) has its sender as destination and originator.
struct Rrep {
  std::uint8_t hops = 0;  ///< From the transmitter to the destination.
  AgentId destination;
  AodvSequence destination_sequence = 0;
  AgentId originator{};  ///< Originator of the request.
  Duration lifetime{};   ///< >= 0; transmitted in ms, rounded down.
  bool operator==(const Rrep&) const = default;
};

/// Route error (section 5.3).
struct Rerr {
  bool no_delete = false;  ///< 'N': the link was repaired, the route only got longer.
  /// Destinations that the transmitter can no longer reach: 1..255.
  std::vector<std::pair<AgentId, AodvSequence>> unreachable;
  bool operator==(const Rerr&) const = default;
};

using AodvMessage = std::variant<Rreq, Rrep, Rerr>;

/// Name used by the RFC: "RREQ".
std::string_view name_of(const AodvMessage& message);

/// A message with its TTL, which the RFC keeps in the IP header.
struct AodvPacket {
  std::uint8_t ttl = 1;  ///< >= 1.
  AodvMessage message;
  bool operator==(const AodvPacket&) const = default;
};

/// The body of a Control packet: u8 TTL, then the message in the format of RFC 3561, sections 5.1
/// to 5.3, addresses in the low 16 of 32 bits.
Bytes encode(const AodvPacket& packet);
/// nullopt if it violates a rule: type, length, broadcast addresses, unused bits.
std::optional<AodvPacket> parse_aodv(const Bytes& body);

}  // namespace hal::node::routing
