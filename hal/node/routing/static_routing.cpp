#include "hal/node/routing/static_routing.h"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include "hal/node/routing/frame_name.h"
#include "hal/node/routing/message_end.h"
#include "hal/node/routing/route_table.h"
#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

Route reported(std::string_view topic, const StaticRoute& route) {
  return {.topic = std::string(topic),
          .destination = route.to,
          .next_hop = route.via,
          .path = {.hops = route.hops}};
}

/// By destination. @pre as StaticRouting.
std::vector<StaticRoute> sorted(std::vector<StaticRoute> routes, AgentId self) {
  std::ranges::sort(routes, {}, &StaticRoute::to);
  const bool is_twice = std::ranges::adjacent_find(routes, {}, &StaticRoute::to) != routes.end();
  const bool is_own = std::ranges::any_of(
      routes, [self](const StaticRoute& route) { return route.to == self || route.via == self; });
  BARAKA_CHECK(!is_twice && !is_own);
  return routes;
}

}  // namespace

StaticRouting::StaticRouting(AgentId self, const RoutingConfig& config,
                             const RouterStreams& streams, const RouterPorts& ports)
    : hops_(self, config, streams, ports, *this),
      node_(hops_.node()),
      table_(sorted(config.statics.routes, self)) {}

const StaticRoute* StaticRouting::find(AgentId destination) const {
  const auto found = std::ranges::lower_bound(table_, destination, {}, &StaticRoute::to);
  return found == table_.end() || found->to != destination ? nullptr : &*found;
}

void StaticRouting::note_class(std::string_view topic) {
  if (classes_.contains(topic) || classes_.size() >= RouteTable::kMostClasses) return;
  classes_.emplace(topic);
  for (const StaticRoute& route : table_) {
    node_.ports.observer.on_route_change({.route = reported(topic, route), .removed = false});
  }
}

std::vector<Route> StaticRouting::routes(std::string_view topic, AgentId destination) const {
  const StaticRoute* const route = find(destination);
  if (route == nullptr) return {};
  return {reported(topic, *route)};
}

std::vector<Route> StaticRouting::routes() const {
  std::vector<Route> all;
  for (const std::string& topic : classes_) {
    for (const StaticRoute& route : table_) all.push_back(reported(topic, route));
  }
  return all;
}

bool StaticRouting::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  return hops_.on_frame(reception, bytes);
}

void StaticRouting::on_transmitted(const Transmission& transmission) {
  hops_.on_transmitted(transmission);
}

void StaticRouting::send(const Message& message) {
  if (is_broadcast(message.destination)) return flooding_.send(message);
  note_class(message.topic);
  forward(to_transit(node_, message));
}

/// Packets of other protocols are ignored.
bool StaticRouting::on_packet(Packet packet, const Arrival& arrival) {
  if (auto* data = std::get_if<Data>(&packet)) on_data(std::move(*data), arrival.reception.from);
  return true;
}

void StaticRouting::on_data(Data data, AgentId from) {
  const Header& header = data.header;
  if (is_broadcast(header.destination)) return flooding_.on_data(std::move(data));
  if (header.destination == node_.self) {
    const bool is_new = delivered_.note({header.source, header.sequence}, node_.now()).second;
    if (is_new) deliver(node_, std::move(data));
    return;
  }
  const auto key = std::make_tuple(header.source, header.sequence, data.transmissions);
  if (!relayed_.note(key, node_.now()).second) return;
  note_class(header.topic);
  forward({.data = std::move(data), .came_from = from, .owes_fate = false});
}

void StaticRouting::forward(Transit transit) {
  if (transit.data.transmissions >= node_.config.hop_limit) {
    return end_message(node_, transit, Verdict::kExpired);
  }
  const StaticRoute* const route = find(transit.data.header.destination);
  if (route == nullptr) return end_message(node_, transit, Verdict::kNoRoute);
  hops_.outbox().send_message(route->via, std::move(transit));
}

void StaticRouting::on_sent(Transit transit, Verdict verdict) {
  if (is_broadcast(transit.data.header.destination)) return flooding_.on_sent(transit, verdict);
  if (verdict == Verdict::kDelivered) return hand_over(node_, transit);
  end_message(node_, transit, verdict);
}

constexpr std::array kStaticEvents{ProtocolEvent::kFloodRelayed, ProtocolEvent::kFloodCopyDropped};

constinit const ProtocolKind kStaticRoutingKind{
    .name = "static",
    .make = make_as<StaticRouting>,
    .name_frame = [](const SentFrame& frame) { return frame_name(frame.bytes, no_control); },
    // There is only one next hop.
    .weigh = [](const RoutingConfig&, const Route&) -> std::optional<double> { return 1; },
    .events = kStaticEvents};

}  // namespace hal::node::routing
