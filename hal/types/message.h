#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace hal {

using Bytes = std::vector<std::uint8_t>;

/// Number of a message among those its sender sent: 1, 2, 3, …  0 is no message.
using MessageId = std::uint32_t;

/// Longest topic, in bytes. A topic names the message class; routing keeps a table per topic.
inline constexpr std::size_t kMaxTopic = 32;
/// Topics that one agent may give its messages: each costs a table in every node that routes for
/// it.
inline constexpr std::size_t kMaxTopics = 256;
/// Longest payload a controller may send, in bytes: one MSDU (2304 B, IEEE Std
/// 802.11-2016, 9.2.4.7) less room for the routing header with the longest path.
inline constexpr std::size_t kMaxPayload = 2048;

/// What one agent says to another, end to end.
struct Message {
  AgentId source;
  AgentId destination;  ///< kEveryone: flooded through the whole network. kNeighbours: one hop.
  MessageId id = 0;
  std::string topic;
  Bytes payload;
  bool operator==(const Message&) const = default;
};

/// What became of a message at its sender.
enum class Fate : std::uint8_t {
  /// The next hop acknowledged it. To everyone or the neighbours: it left the antenna; nobody
  /// acknowledges that, and it may have reached nobody at all.
  kHandedOver,
  kNoRoute,    ///< Discovery failed, or it waited too long for a route.
  kQueueFull,  ///< A queue of the sender had no room.
  kFailed,     ///< No next hop acknowledged it, or the radio was off.
};

/// "handed over", "no route", "queue full", "failed".
std::string_view to_string(Fate fate);

}  // namespace hal
