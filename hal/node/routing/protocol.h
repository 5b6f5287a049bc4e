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

/// Interface of a routing protocol behind a Router, whose comments describe the members. Portable
/// node code: time, radio and random numbers are parameters. One thread.
class Protocol {
 public:
  virtual ~Protocol() = default;

  /// @pre as Router::send().
  virtual void send(const Message& message) = 0;
  virtual void invalidate(std::string_view topic, AgentId destination) = 0;

  virtual std::vector<Route> routes(std::string_view topic, AgentId destination) const = 0;
  virtual std::vector<Route> routes() const = 0;
  virtual std::vector<Neighbour> neighbours() const = 0;

  /// @pre the frame is from another node.
  /// @return false: the frame is malformed, or contradicts its reception.
  virtual bool on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) = 0;
  virtual void on_transmitted(const Transmission& transmission) = 0;
};

/// ProtocolKind::make for a class whose constructor has these parameters.
template <class Made>
std::unique_ptr<Protocol> make_as(AgentId self, const RoutingConfig& config,
                                  const RouterStreams& streams, const RouterPorts& ports) {
  return std::make_unique<Made>(self, config, streams, ports);
}

/// The protocol that `config.algorithm` names.
/// @pre every value that it uses is in the range stated in its comment; aborts otherwise.
std::unique_ptr<Protocol> make_protocol(AgentId self, const RoutingConfig& config,
                                        const RouterStreams& streams, const RouterPorts& ports);

}  // namespace hal::node::routing
