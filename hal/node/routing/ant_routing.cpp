#include "hal/node/routing/ant_routing.h"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include "hal/node/routing/frame_name.h"
#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::node::routing {
namespace {

bool choice_is_valid(const RouteChoice& choice) {
  const PathMetric& metric = choice.metric;
  const auto weight = [&metric](PathStatistic statistic) { return metric.weight(statistic); };
  return choice.beta >= 1 && metric.direct_weight >= 0 &&
         std::ranges::all_of(kPathStatistics, [&](auto s) { return weight(s) >= 0; }) &&
         std::ranges::any_of(kPathStatistics, [&](auto s) { return weight(s) > 0; });
}

/// Checks the parameters of ants, not those of the layer below.
bool ants_are_valid(const RoutingConfig& config) {
  const auto is_good = [](const auto& entry) { return choice_is_valid(entry.second); };
  return choice_is_valid(config.choice) && std::ranges::all_of(config.classes, is_good) &&
         config.retry_period > Duration::zero() && config.retry_jitter >= 0 &&
         config.retry_jitter <= 1 && config.retries >= 1 && config.acceptance >= 1 &&
         config.buffer_age > Duration::zero();
}

}  // namespace

AntRouting::AntRouting(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
                       const RouterPorts& ports)
    : hops_(self, config, streams, ports, *this), table_(ports.observer) {
  BARAKA_CHECK(ants_are_valid(config));
}

void AntRouting::send(const Message& message) {
  if (is_broadcast(message.destination)) {
    flooding_.send(message);
  } else {
    forwarding_.send(message);
  }
}

void AntRouting::invalidate(std::string_view topic, AgentId destination) {
  table_.remove(topic, destination);
}

std::vector<Route> AntRouting::routes(std::string_view topic, AgentId destination) const {
  return table_.routes(topic, destination);
}

bool AntRouting::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  return hops_.on_frame(reception, bytes);
}

void AntRouting::on_transmitted(const Transmission& transmission) {
  hops_.on_transmitted(transmission);
}

void AntRouting::on_no_answer(AgentId neighbour) { table_.remove_via(neighbour); }

void AntRouting::on_sent(Transit transit, Verdict verdict) {
  if (is_broadcast(transit.data.header.destination)) {
    flooding_.on_sent(transit, verdict);
  } else {
    forwarding_.on_sent(std::move(transit), verdict);
  }
}

bool AntRouting::on_packet(Packet packet, const Arrival& arrival) {
  return std::visit([&](auto& kind) { return take(std::move(kind), arrival); }, packet);
}

bool AntRouting::take(ForwardAnt ant, const Arrival& arrival) {
  return ants_.on_forward_ant(std::move(ant), arrival);
}

bool AntRouting::take(BackwardAnt ant, const Arrival& arrival) {
  return ants_.on_backward_ant(std::move(ant), arrival);
}

bool AntRouting::take(Data data, const Arrival& arrival) {
  if (is_broadcast(data.header.destination)) {
    flooding_.on_data(std::move(data));
  } else {
    forwarding_.on_data(std::move(data), arrival.reception.from);
  }
  return true;
}

/// A control packet of another protocol is ignored.
bool AntRouting::take(const Control&, const Arrival&) { return true; }

constexpr std::array kAntEvents{
    ProtocolEvent::kForwardAntSent,     ProtocolEvent::kForwardAntRelayed,
    ProtocolEvent::kForwardAntAnswered, ProtocolEvent::kBackwardAntRelayed,
    ProtocolEvent::kBackwardAntHome,    ProtocolEvent::kFloodRelayed,
    ProtocolEvent::kFloodCopyDropped};

constinit const ProtocolKind kAntRoutingKind{
    .name = "ants",
    .make = make_as<AntRouting>,
    .name_frame = [](const SentFrame& frame) { return frame_name(frame.bytes, no_control); },
    .weigh = [](const RoutingConfig& config, const Route& route) -> std::optional<double> {
      const RouteChoice& choice = config.choice_of(route.topic);
      const bool is_destination = route.next_hop == route.destination;
      return math::pow(path_value(choice.metric, route.path, is_destination), choice.beta);
    },
    .events = kAntEvents};

}  // namespace hal::node::routing
