#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "hal/node/routing/ports.h"
#include "hal/node/routing/routing_config.h"
#include "hal/types/message.h"
#include "hal/types/route.h"

namespace hal::node::routing {

class Protocol;

/// Routing of one node, by the protocol that RoutingConfig::algorithm names.
///
/// Over a link without tx_status each unicast frame is repeated until the next hop's router
/// acknowledges it (hop_acknowledgement.h), and hellos reveal the neighbours (hello.h). With
/// Algorithm::kNone there is none of this: each message is one frame (one_hop.h).
///
/// Portable node code: time, radio and random numbers are parameters. One thread.
class Router {
 public:
  Router(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
         RouterPorts ports);
  ~Router();
  Router(const Router&) = delete;
  Router& operator=(const Router&) = delete;

  /// Sends a message of this node: `message.source` is self, `message.destination` another node or
  /// kEveryone. Its fate is reported once through Application::on_fate, never from within send():
  /// kHandedOver when the first hop acknowledged it (a flood: when it was transmitted or, without
  /// tx_status, accepted by the link), otherwise the reason of the failure.
  /// @pre id > 0, topic and payload within kMaxTopic and kMaxPayload; aborts otherwise.
  void send(const Message& message);

  /// Forgets all routes of the class to the destination, at this node only. Running discoveries
  /// continue.
  void invalidate(std::string_view topic, AgentId destination);

  /// Routes by next hop; empty if there is none.
  std::vector<Route> routes(std::string_view topic, AgentId destination) const;

  /// All routes, by topic, destination and next hop; and the neighbours, by address. For users that
  /// did not observe the router from the start.
  std::vector<Route> routes() const;
  std::vector<Neighbour> neighbours() const;

  /// From the link: any bytes from any transmitter; malformed frames are dropped and counted.
  void on_frame(const Reception& reception, std::span<const std::uint8_t> bytes);
  /// From the link; ignored if it has no tx_status.
  void on_transmitted(const Transmission& transmission);

  /// Frames that could not be parsed, were transmitted by this node or by kEveryone, or belong to
  /// the protocol but contradict their reception.
  std::uint64_t malformed_frames() const;

 private:
  std::unique_ptr<Protocol> protocol_;
  AgentId self_;
  std::uint64_t malformed_ = 0;
};

}  // namespace hal::node::routing
