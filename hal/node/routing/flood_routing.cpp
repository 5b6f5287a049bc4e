#include "hal/node/routing/flood_routing.h"

#include <array>
#include <utility>
#include <variant>

#include "hal/node/routing/frame_name.h"

namespace hal::node::routing {
namespace {

/// Time allowed for a hop in addition to its jitter: queueing and medium access.
constexpr Duration kHopTime = 100ms;

}  // namespace

FloodRouting::FloodRouting(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
                           const RouterPorts& ports)
    : hops_(self, config, streams, ports, *this) {}

bool FloodRouting::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  return hops_.on_frame(reception, bytes);
}

void FloodRouting::on_transmitted(const Transmission& transmission) {
  hops_.on_transmitted(transmission);
}

/// Packets of other protocols are ignored.
bool FloodRouting::on_packet(Packet packet, const Arrival&) {
  if (auto* data = std::get_if<Data>(&packet)) flooding_.on_data(std::move(*data));
  return true;
}

void FloodRouting::on_sent(Transit transit, Verdict verdict) {
  flooding_.on_sent(transit, verdict);
  const Header& header = transit.data.header;
  const bool is_flying = transit.owes_fate && verdict == Verdict::kDelivered;
  if (!is_flying || is_broadcast(header.destination)) return;
  Node& node = hops_.node();
  node.timers.schedule(node.now() + longest_flood(), [&node, id = transit.data.id, header] {
    node.ports.observer.on_message_end(header.source, id, header.topic, Verdict::kExpired);
  });
}

Duration FloodRouting::longest_flood() {
  const RoutingConfig& config = hops_.node().config;
  return config.hop_limit * (config.jitter_max + kHopTime);
}

constexpr std::array kFloodEvents{ProtocolEvent::kFloodRelayed, ProtocolEvent::kFloodCopyDropped};

constinit const ProtocolKind kFloodRoutingKind{
    .name = "flooding",
    .make = make_as<FloodRouting>,
    .name_frame = [](const SentFrame& frame) { return frame_name(frame.bytes, no_control); },
    .weigh = no_weight,
    .events = kFloodEvents};

}  // namespace hal::node::routing
