#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/priority.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace hal::node::routing {

/// Number of a packet among those of its source: orders ants, identifies duplicates.
using Sequence = std::uint32_t;

/// The common part of all packets.
struct Header {
  std::string topic;    ///< Message class, 1..kMaxTopic bytes.
  AgentId source;       ///< The node that created the packet.
  AgentId destination;  ///< Its final destination; kEveryone, kNeighbours: data only.
  /// Numbered by the source; a backward ant repeats its forward ant's number.
  Sequence sequence = 0;
  bool operator==(const Header&) const = default;
};

/// Searches for a route: flooded from `source`, answered by `destination`.
struct ForwardAnt {
  Header header;
  Time started{};             ///< When `source` sent it, by the clock of `source`.
  std::vector<AgentId> path;  ///< `source` and every relay so far; the last one is the transmitter.
  PathStatistics way;         ///< From the transmitter back to `source`.
  bool operator==(const ForwardAnt&) const = default;
};

/// Follows a forward ant's path in reverse: from `source`, the node that was searched, to
/// `destination`, the node that started the search.
struct BackwardAnt {
  Header header;
  std::vector<AgentId> path;  ///< The forward ant's path: path[0] is `destination`.
  std::uint8_t position = 0;  ///< Index in `path` of the receiver of this frame.
  PathStatistics way;         ///< From the transmitter to `source`.
  bool operator==(const BackwardAnt&) const = default;
};

/// An application message in transit.
struct Data {
  Header header;
  MessageId id = 0;
  std::uint8_t transmissions = 0;  ///< So far, including this one; at least 1 on the air.
  Bytes payload;
  Priority priority{};  ///< Of every frame that carries it.
  bool operator==(const Data&) const = default;
};

/// Protocol of a control packet.
enum class ControlOf : std::uint8_t { kAodv = 1, kAntHocNet = 2 };

/// A control packet of a protocol with its own format.
struct Control {
  ControlOf protocol = ControlOf::kAodv;
  Bytes body;  ///< 1 .. kMaxControl bytes in the format of the protocol.
  bool operator==(const Control&) const = default;
};
inline constexpr std::size_t kMaxControl = 2048;

using Packet = std::variant<ForwardAnt, BackwardAnt, Data, Control>;

/// Longest path of an ant, in nodes: its length is transmitted in one byte.
inline constexpr std::size_t kMaxPath = 255;

/// The bytes of a packet on a link, integers big-endian:
///
///   octet  0       version (high nibble, 1) and kind (low nibble: 1 forward ant, 2 backward ant,
///                  3 data, 10 control, 14 data with a priority)
///   control        u8 protocol, its body to the end of the frame; all other kinds:
///          1       length of the topic, then the topic
///          u16 source, u16 destination, u32 sequence, then by kind
///   forward ant    i64 started [ns], way, path
///   backward ant   u8 position, way, path
///   data           u32 message id, u8 transmissions, payload to the end of the frame
///   with priority  u8 priority (1..7), then as data
///
/// way: u16 hops, i64 delay [ns], f64 minimum SNR [dB], f64 energy [J]; path: u8 count, u16 each.
/// @pre the packet satisfies the rules that parse() checks.
Bytes encode(const Packet& packet);

/// The packet in a frame; nullopt if the frame violates a rule: length, ranges, or an ant whose
/// path, position and hop count contradict each other.
std::optional<Packet> parse(std::span<const std::uint8_t> frame);

}  // namespace hal::node::routing
