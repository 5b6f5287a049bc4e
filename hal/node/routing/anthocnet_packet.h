#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/node/routing/packet.h"

namespace hal::node::routing::anthocnet {

/// Purpose of an ant.
enum class AntKind : std::uint8_t {
  kReactive,   ///< Finds a first path.
  kProactive,  ///< Finds better paths while a session runs.
  kRepair,     ///< Finds a path around a link that broke while a message used it.
};
inline constexpr int kAntKindCount = 3;

/// Searches paths from header.source to header.destination.
struct ForwardAnt {
  Header header;
  AntKind kind = AntKind::kReactive;
  std::uint8_t broadcasts = 0;  ///< Number of broadcasts so far, including this one.
  PathStatistics way;           ///< From the transmitter back to the source.
  /// The source and every relay so far; the last one is the transmitter.
  std::vector<AgentId> path;
  bool operator==(const ForwardAnt&) const = default;
};

/// Follows a forward ant's path in reverse and lays pheromone towards header.source, the node that
/// was searched. header.destination started the search.
struct BackwardAnt {
  Header header;
  AntKind kind = AntKind::kReactive;
  std::uint8_t position = 0;  ///< Index in `path` of the receiver of this frame.
  PathStatistics way;         ///< From the transmitter to header.source.
  std::vector<AgentId> path;  ///< The forward ant's path: path[0] is header.destination.
  bool operator==(const BackwardAnt&) const = default;
};

/// A destination, for the messages of one class.
struct Target {
  std::string topic;
  AgentId destination;
  auto operator<=>(const Target&) const = default;
};

/// The best path of a neighbour to a target.
struct Scent {
  Target target;
  AgentId next_hop;         ///< On that path; that node ignores the entry.
  bool is_virtual = false;  ///< Derived from hellos, not laid by an ant.
  std::uint8_t hops = 0;    ///< 1..; undefined if it is virtual.
  double pheromone = 0;     ///< 1/s, > 0.
  bool operator==(const Scent&) const = default;
};

/// Hello with the best paths of its sender, to all neighbours.
struct PheromoneHello {
  /// Longest time until the next hello, 1 ms..1 h; transmitted in ms, rounded up.
  Duration period{};
  std::vector<Scent> scents;
  bool operator==(const PheromoneHello&) const = default;
};

/// A target that the transmitter can no longer reach, or only on a longer path.
struct LostPath {
  Target target;
  std::uint8_t hops = 0;  ///< Length of the best remaining path; 0: none.
  AgentId next_hop{};     ///< First node of that path; undefined without one.
  Duration delay{};       ///< Delay of that path; undefined without one.
  bool operator==(const LostPath&) const = default;
};

/// Notifies all neighbours of paths that were lost with a broken link.
struct LossNotice {
  std::vector<LostPath> lost;  ///< At least one.
  bool operator==(const LossNotice&) const = default;
};

/// Notifies the neighbour that sent a message that this node has no path for it.
struct Warning {
  Target target;
  bool operator==(const Warning&) const = default;
};

using ControlPacket = std::variant<ForwardAnt, BackwardAnt, PheromoneHello, LossNotice, Warning>;

/// "forward ant", "backward ant", "hello", …
std::string_view name_of(const ControlPacket& packet);

/// Maximum number of targets in one hello or loss notice, so that it fits into a control packet
/// with topics of any length.
inline constexpr std::size_t kMostTargets = 20;

/// The body of a control packet (Control of packet.h), integers big-endian:
///
///   octet  0       1 forward ant, 2 backward ant, 3 hello, 4 loss notice, 5 warning
///   ants           text topic, u16 source, u16 destination, u32 sequence, u8 kind (0 reactive,
///                  1 proactive, 2 repair), u8 broadcasts or position, way, path
///   hello          u32 period [ms], u8 count, scents: target, u16 next hop, u8 virtual, u8 hops,
///                  f64 pheromone [1/s]
///   loss notice    u8 count, paths: target, u8 hops, u16 next hop, i64 delay [ns]
///   warning        target
///
/// text: u8 length, then its octets; target: text topic, u16 destination; way: u16 hops,
/// i64 delay [ns], f64 minimum SNR [dB], f64 energy [J]; path: u8 count, u16 each.
/// @pre the packet satisfies the rules that parse_control() checks.
Bytes encode_control(const ControlPacket& packet);

/// The packet in such a body; nullopt if it violates a rule: length, ranges, or an ant whose path,
/// position and hop count contradict each other.
std::optional<ControlPacket> parse_control(std::span<const std::uint8_t> bytes);

}  // namespace hal::node::routing::anthocnet
