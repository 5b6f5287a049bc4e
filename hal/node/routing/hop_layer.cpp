#include "hal/node/routing/hop_layer.h"

#include <utility>
#include <variant>

#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

bool layer_is_valid(const RoutingConfig& config) {
  return config.jitter_max >= Duration::zero() && config.hop_limit >= 1 &&
         config.hop_limit <= static_cast<int>(kMaxPath) && config.ack_timeout > Duration::zero() &&
         config.ack_attempts >= 1 && config.ack_attempts <= 16 && config.hello_limit >= 1 &&
         config.hello_period >= 1ms && config.hello_period <= kMaxHelloPeriod;
}

RouterPorts ports_over(Link& link, const RouterPorts& ports) {
  return {link, ports.timers, ports.application, ports.observer};
}

}  // namespace

HopLayer::HopLayer(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
                   const RouterPorts& ports, HopListener& listener)
    : has_status_(ports.link.capabilities().tx_status),
      listener_(listener),
      acknowledgement_(config, ports.link, ports.timers,
                       [this](const auto& report) { outbox_.on_transmitted(report); }),
      node_{self,
            config,
            streams.random,
            streams.retries,
            ports_over(has_status_ ? ports.link : acknowledgement_, ports),
            OwnTimers(ports.timers)},
      hellos_(node_, ports.link, [this](AgentId neighbour) { give_up(neighbour); }) {
  BARAKA_CHECK(layer_is_valid(config));
  if (!has_status_) hellos_.start();
}

void HopLayer::on_no_answer(AgentId neighbour) {
  listener_.on_no_answer(neighbour);
  neighbourhood_.on_no_answer(neighbour);
}

void HopLayer::give_up(AgentId neighbour) {
  on_no_answer(neighbour);
  acknowledgement_.give_up(neighbour);
}

void HopLayer::on_sent(Transit transit, Verdict verdict) {
  listener_.on_sent(std::move(transit), verdict);
}

bool HopLayer::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  auto frame = parse_frame(bytes);
  if (!frame) return false;
  neighbourhood_.on_heard(reception);
  if (!has_status_) hellos_.on_heard(reception.from);
  const Arrival arrival{reception, bytes.size()};
  return std::visit([&](auto& kind) { return take(std::move(kind), arrival); }, *frame);
}

bool HopLayer::take(Packet packet, const Arrival& arrival) {
  return listener_.on_packet(std::move(packet), arrival);
}

/// Handles the packet before it acknowledges it, because the message is more urgent.
bool HopLayer::take(Numbered numbered, const Arrival& arrival) {
  const AgentId from = arrival.reception.from;
  const auto* const data = std::get_if<Data>(&numbered.packet);
  const Priority priority = data != nullptr ? data->priority : node_.config.control_priority;
  const bool is_first = acknowledgement_.on_numbered(from, numbered.number);
  const bool is_good = !is_first || listener_.on_packet(std::move(numbered.packet), arrival);
  acknowledgement_.acknowledge(from, numbered.number, priority);
  return is_good;
}

bool HopLayer::take(HopAck ack, const Arrival& arrival) {
  acknowledgement_.on_ack(arrival.reception.from, ack.number);
  return true;
}

bool HopLayer::take(Hello hello, const Arrival& arrival) {
  if (!has_status_) hellos_.on_hello(arrival.reception.from, hello);
  return true;
}

void HopLayer::on_transmitted(const Transmission& transmission) {
  if (has_status_) outbox_.on_transmitted(transmission);
}

}  // namespace hal::node::routing
