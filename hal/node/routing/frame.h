#pragma once

#include <optional>
#include <span>
#include <variant>

#include "hal/node/routing/packet.h"

namespace hal::node::routing {

/// Number of a frame among those that its transmitter wants to be acknowledged.
using HopNumber = std::uint32_t;

/// A unicast packet that the next hop shall acknowledge: a backward ant, data for one node, or a
/// control packet.
struct Numbered {
  HopNumber number = 0;
  Packet packet;
  bool operator==(const Numbered&) const = default;
};

/// Acknowledgement of a frame, to the neighbour that transmitted it.
struct HopAck {
  HopNumber number = 0;
  bool operator==(const HopAck&) const = default;
};

/// Longest time between two hellos.
inline constexpr Duration kMaxHelloPeriod = std::chrono::hours{1};

/// Hello, to all neighbours.
struct Hello {
  /// Longest time until the next, 1 ms..kMaxHelloPeriod; travels in ms, rounded up.
  Duration period{};
  bool operator==(const Hello&) const = default;
};

/// What one frame on a link is. Over a link with transmit status all frames are bare packets.
using Frame = std::variant<Packet, Numbered, HopAck, Hello>;

/// The bytes of the frames that are not bare packets, integers big-endian. Octet 0 is as in
/// encode(const Packet&), with more kinds:
///
///   octet  0       version 1, kind 4 numbered, 5 hop acknowledgement, 6 hello
///   numbered       u32 number, the packet's bytes
///   hop ack        u32 number
///   hello          u32 period [ms] (after INTERVAL_TIME of RFC 5497: who listens need not know the
///                  configuration of who talks)
Bytes encode_numbered(HopNumber number, const Bytes& packet);
Bytes encode(const HopAck& ack);
/// @pre the period keeps its range.
Bytes encode(const Hello& hello);

/// The frame in some bytes; none if they break any rule, those of parse() included.
std::optional<Frame> parse_frame(std::span<const std::uint8_t> bytes);

/// The packet in a frame; null if it carries none.
const Packet* packet_in(const Frame& frame);

}  // namespace hal::node::routing
