#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "hal/node/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/route.h"

namespace hal::node::routing {

class Protocol;
struct RouterPorts;
struct RouterStreams;
struct RoutingConfig;

/// A frame of routing as transmitted by one node to another, or to all (kEveryone).
struct SentFrame {
  AgentId from, to;
  std::span<const std::uint8_t> bytes;
};

/// Kind of such a frame, for records.
struct FrameName {
  struct MessageName {
    AgentId sender;
    MessageId id = 0;
    bool operator==(const MessageName&) const = default;
  };
  /// "data", "RREQ", "hello", …; "": not a frame of the protocol.
  std::string_view kind;
  std::optional<MessageName> message{};  ///< The application message that it carries.
};

/// Description of a routing protocol, defined beside its Protocol.
struct ProtocolKind {
  using Make = std::unique_ptr<Protocol> (*)(AgentId self, const RoutingConfig& config,
                                             const RouterStreams& streams,
                                             const RouterPorts& ports);
  using NameFrame = FrameName (*)(const SentFrame& frame);
  using Weigh = std::optional<double> (*)(const RoutingConfig& config, const Route& route);

  std::string_view name;  ///< As used in files and records.
  Make make;              ///< Makes the protocol of one node. @pre as make_protocol()
  NameFrame name_frame;   ///< Names a frame that one of its nodes transmitted.
  /// Weight of a route: a message takes it with the probability weight / sum of the weights of all
  /// routes of its topic and destination. nullopt: the protocol does not choose by weights.
  Weigh weigh;
  /// Events that its nodes count, in addition to lost neighbours and, over a link without transmit
  /// status, hellos. Events in this list that did not occur are counted as 0; for all others there
  /// is no count. Empty: nodes only pass messages to the link.
  std::span<const ProtocolEvent> events{};
};

/// Choice of the routing protocol: one of these, or any other ProtocolKind.
class Algorithm {
 public:
  /// @param kind  outlives everything that uses it.
  // NOLINTNEXTLINE(google-explicit-constructor): a kind of protocol is an algorithm
  constexpr Algorithm(const ProtocolKind& kind) : kind_(&kind) {}

  static const Algorithm kAnts;
  static const Algorithm kNone;       ///< No routing: one hop, directly by the link (one_hop.h).
  static const Algorithm kFlooding;   ///< Floods every message (flood_routing.h).
  static const Algorithm kAodv;       ///< RFC 3561 (aodv_routing.h).
  static const Algorithm kAntHocNet;  ///< AntHocNet in full (anthocnet.h).
  static const Algorithm kStatic;     ///< Routes that never change (static_routing.h).

  const ProtocolKind& kind() const { return *kind_; }
  std::string_view name() const { return kind_->name; }
  /// The same kind.
  constexpr bool operator==(const Algorithm&) const = default;

 private:
  const ProtocolKind* kind_;
};

extern const ProtocolKind kAntRoutingKind, kOneHopKind, kFloodRoutingKind, kAodvKind,
    kAntHocNetKind, kStaticRoutingKind;

inline constexpr Algorithm Algorithm::kAnts{kAntRoutingKind};
inline constexpr Algorithm Algorithm::kNone{kOneHopKind};
inline constexpr Algorithm Algorithm::kFlooding{kFloodRoutingKind};
inline constexpr Algorithm Algorithm::kAodv{kAodvKind};
inline constexpr Algorithm Algorithm::kAntHocNet{kAntHocNetKind};
inline constexpr Algorithm Algorithm::kStatic{kStaticRoutingKind};

}  // namespace hal::node::routing
