#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/priority.h"
#include "hal/types/time.h"

namespace hal {

/// Octets of a payload or a frame.
using Bytes = std::vector<std::uint8_t>;

/// Number of a message among those of its sender: 1, 2, 3, …; 0: no message.
using MessageId = std::uint32_t;

/// Longest topic, in bytes. A topic names the message class; routing keeps a table per topic.
inline constexpr std::size_t kMaxTopic = 32;
/// Most topics that one agent may use: every node that routes for it keeps a table per topic.
inline constexpr std::size_t kMaxTopics = 256;
/// Longest payload a controller may send, in bytes: one MSDU (2304 B, IEEE Std
/// 802.11-2016, 9.2.4.7) less room for the routing header with the longest path.
inline constexpr std::size_t kMaxPayload = 2048;

/// A message from one agent to another, end to end.
struct Message {
  AgentId source;       ///< The agent that called send().
  AgentId destination;  ///< kEveryone: flooded through the whole network. kNeighbours: one hop.
  MessageId id = 0;     ///< Unique among the messages of `source`.
  std::string topic;    ///< Message class, 1 .. kMaxTopic bytes.
  Bytes payload;        ///< 0 .. kMaxPayload bytes, not interpreted by the network.
  Priority priority{};  ///< As its sender gave it, or the file of its sender.
  bool operator==(const Message&) const = default;  ///< Member by member.
};

/// The result of a send() as its sender learns it.
enum class Fate : std::uint8_t {
  /// The next hop acknowledged the message. A broadcast was transmitted: it is not acknowledged
  /// and may not have been received at all.
  kHandedOver,
  kNoRoute,    ///< Discovery failed, or it waited too long for a route.
  kQueueFull,  ///< A queue of the sender had no room.
  kFailed,     ///< No next hop acknowledged it, or the radio was off.
};

/// "handed over", "no route", "queue full", "failed".
std::string_view to_string(Fate fate);

}  // namespace hal
