#pragma once

#include <optional>
#include <span>
#include <variant>

#include "hal/node/routing/packet.h"

namespace hal::node::routing {

/// Number of a frame, among those of its transmitter that require acknowledgement.
using HopNumber = std::uint32_t;

/// A unicast packet that the next hop must acknowledge: a backward ant, data for one node, or a
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
  /// Longest time until the next hello, 1 ms..kMaxHelloPeriod; transmitted in ms, rounded up.
  Duration period{};
  bool operator==(const Hello&) const = default;
};

/// The contents of one frame on a link. Over a link with transmit status all frames are bare
/// packets.
using Frame = std::variant<Packet, Numbered, HopAck, Hello>;

/// The bytes of the frames that are not bare packets, integers big-endian. Octet 0 is as in
/// encode(const Packet&), with more kinds:
///
///   octet  0       version 1, kind 4 numbered, 5 hop acknowledgement, 6 hello
///   numbered       u32 number, the packet's bytes
///   hop ack        u32 number
///   hello          u32 period [ms] (as INTERVAL_TIME of RFC 5497: the receiver need not know the
///                  configuration of the transmitter)
Bytes encode_numbered(HopNumber number, const Bytes& packet);
Bytes encode(const HopAck& ack);
/// @pre the period is in its range.
Bytes encode(const Hello& hello);

/// The frame in these bytes; nullopt if they violate a rule, including those of parse().
std::optional<Frame> parse_frame(std::span<const std::uint8_t> bytes);

/// The packet in a frame; null if there is none.
const Packet* packet_in(const Frame& frame);

}  // namespace hal::node::routing
