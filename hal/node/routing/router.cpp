#include "hal/node/routing/router.h"

#include "hal/node/routing/protocol.h"
#include "hal/types/check.h"

namespace hal::node::routing {

Router::Router(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
               RouterPorts ports)
    : protocol_(make_protocol(self, config, streams, ports)), self_(self) {}

Router::~Router() = default;

void Router::send(const Message& message) {
  BARAKA_CHECK(message.source == self_ && message.destination != message.source);
  BARAKA_CHECK(message.id != 0 && !message.topic.empty() && message.topic.size() <= kMaxTopic);
  BARAKA_CHECK(message.payload.size() <= kMaxPayload);
  protocol_->send(message);
}

void Router::invalidate(std::string_view topic, AgentId destination) {
  protocol_->invalidate(topic, destination);
}

std::vector<Route> Router::routes(std::string_view topic, AgentId destination) const {
  return protocol_->routes(topic, destination);
}

std::vector<Route> Router::routes() const { return protocol_->routes(); }

std::vector<Neighbour> Router::neighbours() const { return protocol_->neighbours(); }

void Router::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  const AgentId from = reception.from;
  const bool is_foreign = from != self_ && !is_broadcast(from);
  if (!is_foreign || !protocol_->on_frame(reception, bytes)) ++malformed_;
}

void Router::on_transmitted(const Transmission& transmission) {
  protocol_->on_transmitted(transmission);
}

std::uint64_t Router::malformed_frames() const { return malformed_; }

}  // namespace hal::node::routing
