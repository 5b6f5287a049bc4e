#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "hal/node/routing/neighbourhood.h"
#include "hal/node/routing/own_timers.h"
#include "hal/node/routing/protocol.h"

namespace hal::node::routing {

/// Replaces routing with `RoutingConfig::algorithm` kNone: a message is one frame to its
/// destination, or a broadcast (kNeighbours and kEveryone alike), and is not forwarded. Its fate is
/// the link's verdict on that frame. The bytes of the frame, integers big-endian, 6 octets plus the
/// topic and the payload:
///
///   octet  0       version 1 (high nibble), kind (low nibble): 7 to one node, 8 to the neighbours,
///                  9 to everyone; 11, 12 and 13: the same with a priority
///          1       length of the topic, then the topic
///          u32     message id
///          u8      with a priority: 1..7
///                  then the payload to the end of the frame
///
/// Source and destination are those of the link's own frame.
Bytes encode_one_hop(const Message& message);

/// The message in a frame that `from` transmitted and `self` received; nullopt if the bytes are not
/// such a frame.
std::optional<Message> parse_one_hop(std::span<const std::uint8_t> bytes, AgentId from,
                                     AgentId self);

/// Octets of such a frame in addition to topic and payload, without a priority.
inline constexpr std::size_t kOneHopHeader = 6;

/// One node of that protocol.
class OneHop final : public Protocol {
 public:
  OneHop(AgentId self, const RouterPorts& ports);

  void send(const Message& message) override;
  void invalidate(std::string_view, AgentId) override {}
  std::vector<Route> routes(std::string_view, AgentId) const override { return {}; }
  std::vector<Route> routes() const override { return {}; }
  std::vector<Neighbour> neighbours() const override { return neighbourhood_.known(); }
  bool on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) override;
  void on_transmitted(const Transmission& transmission) override;

 private:
  struct Sent {
    AgentId destination;
    std::string topic;
  };

  const AgentId self_;
  const RouterPorts ports_;
  OwnTimers timers_;
  Neighbourhood neighbourhood_;
  std::map<MessageId, Sent> sent_;  ///< Messages that await the link's report.
};

}  // namespace hal::node::routing
