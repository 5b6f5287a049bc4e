#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "hal/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/route.h"

namespace hal::routing {

class Protocol;
struct RouterPorts;
struct RouterStreams;
struct RoutingConfig;

/// A frame of routing as one node transmits it to another, or to all (kEveryone).
struct SentFrame {
  AgentId from, to;
  std::span<const std::uint8_t> bytes;
};

/// What such a frame is, for records.
struct FrameName {
  struct MessageName {
    AgentId sender;
    MessageId id = 0;
    bool operator==(const MessageName&) const = default;
  };
  std::string_view kind;                 ///< "data", "RREQ", "hello", …; "": not the protocol's.
  std::optional<MessageName> message{};  ///< Which it carries for agents.
};

/// A routing protocol, and what is to be known of it without a node that runs it. Each stands
/// beside its Protocol.
struct ProtocolKind {
  using Make = std::unique_ptr<Protocol> (*)(AgentId self, const RoutingConfig& config,
                                             const RouterStreams& streams,
                                             const RouterPorts& ports);
  using NameFrame = FrameName (*)(const SentFrame& frame);
  using Weigh = std::optional<double> (*)(const RoutingConfig& config, const Route& route);

  std::string_view name;  ///< In files and records.
  Make make;              ///< The end of one node. @pre as make_protocol()
  NameFrame name_frame;   ///< Of its nodes' frames.
  /// A message takes a route with this weight's share of the sum over the routes of its topic and
  /// destination; none: the protocol chooses otherwise.
  Weigh weigh;
  /// What its nodes can do, besides losing a neighbour and, over a link that tells nothing of its
  /// frames, saying hello: a count of one of these that nobody made is 0, another does not exist.
  /// Empty: they only hand messages to the link.
  std::span<const ProtocolEvent> events{};
};

/// How messages find their way: one of these protocols, or any other ProtocolKind.
class Algorithm {
 public:
  /// @param kind  outlives everything that uses it.
  // NOLINTNEXTLINE(google-explicit-constructor): a kind of protocol is an algorithm
  constexpr Algorithm(const ProtocolKind& kind) : kind_(&kind) {}

  static const Algorithm kAnts;
  static const Algorithm kNone;       ///< Not at all: one hop, straight to the link (one_hop.h).
  static const Algorithm kFlooding;   ///< Every message to everyone (flood_routing.h).
  static const Algorithm kAodv;       ///< RFC 3561 (aodv_routing.h).
  static const Algorithm kAntHocNet;  ///< AntHocNet in full (anthocnet.h).

  const ProtocolKind& kind() const { return *kind_; }
  std::string_view name() const { return kind_->name; }
  /// The same kind.
  constexpr bool operator==(const Algorithm&) const = default;

 private:
  const ProtocolKind* kind_;
};

extern const ProtocolKind kAntRoutingKind, kOneHopKind, kFloodRoutingKind, kAodvKind,
    kAntHocNetKind;

inline constexpr Algorithm Algorithm::kAnts{kAntRoutingKind};
inline constexpr Algorithm Algorithm::kNone{kOneHopKind};
inline constexpr Algorithm Algorithm::kFlooding{kFloodRoutingKind};
inline constexpr Algorithm Algorithm::kAodv{kAodvKind};
inline constexpr Algorithm Algorithm::kAntHocNet{kAntHocNetKind};

}  // namespace hal::routing
