#include "hal/routing/router.h"

#include <variant>

#include "hal/routing/ants.h"
#include "hal/routing/flooding.h"
#include "hal/routing/frame.h"
#include "hal/routing/hello.h"
#include "hal/routing/hop_acknowledgement.h"
#include "hal/routing/neighbourhood.h"
#include "hal/routing/one_hop.h"
#include "hal/types/check.h"

namespace hal::routing {
namespace {

/// Whether every value is in the range its comment gives.
bool is_valid(const RoutingConfig& config) {
  return config.beta >= 1 && config.direct_weight > 0 && config.jitter_max >= Duration::zero() &&
         config.retry_period > Duration::zero() && config.retry_jitter >= 0 &&
         config.retry_jitter <= 1 && config.retries >= 1 && config.acceptance >= 1 &&
         config.hop_limit >= 1 && config.hop_limit <= static_cast<int>(kMaxPath) &&
         config.buffer_age > Duration::zero() && config.ack_timeout > Duration::zero() &&
         config.ack_attempts >= 1 && config.ack_attempts <= 16 && config.hello_limit >= 1 &&
         config.hello_period >= 1ms && config.hello_period <= kMaxHelloPeriod;
}

}  // namespace

/// The parts of a router, and the way of a frame between them. Over a link without transmit status
/// the parts send through `hop`, which has one.
struct Router::State final : OutboxListener {
  State(AgentId self, const RoutingConfig& config, const RouterStreams& streams, RouterPorts ports)
      : has_status(ports.link.capabilities().tx_status),
        hop(config, ports.link, ports.timers, [this](const auto& t) { outbox.on_transmitted(t); }),
        node{self,
             config,
             streams.random,
             streams.retries,
             ports_over(has_status ? ports.link : hop, ports),
             OwnTimers(ports.timers)},
        table(ports.observer),
        hellos(node, ports.link, [this](AgentId neighbour) { on_silence(neighbour); }) {
    if (!has_status) hellos.start();
  }

  static RouterPorts ports_over(Link& link, const RouterPorts& ports) {
    return {link, ports.timers, ports.application, ports.observer};
  }

  void on_no_answer(AgentId neighbour) override {
    table.remove_via(neighbour);
    neighbourhood.on_no_answer(neighbour);
  }

  void on_silence(AgentId neighbour) {
    on_no_answer(neighbour);
    hop.give_up(neighbour);
  }

  void on_sent(Transit transit, Verdict verdict) override {
    if (is_broadcast(transit.data.header.destination)) {
      flooding.on_sent(transit, verdict);
    } else {
      forwarding.on_sent(std::move(transit), verdict);
    }
  }

  void on_heard(const Reception& reception) {
    neighbourhood.on_heard(reception);
    if (!has_status) hellos.on_heard(reception.from);
  }

  /// @return false if a packet contradicts how it came in.
  bool take(Packet packet, const Arrival& arrival) {
    return std::visit([&](auto& kind) { return take(std::move(kind), arrival); }, packet);
  }
  /// The packet first, its acknowledgement after it: the message is in more of a hurry.
  bool take(Numbered numbered, const Arrival& arrival) {
    const AgentId from = arrival.reception.from;
    const bool is_first = hop.on_numbered(from, numbered.number);
    const bool is_good = !is_first || take(std::move(numbered.packet), arrival);
    hop.acknowledge(from, numbered.number);
    return is_good;
  }
  bool take(HopAck ack, const Arrival& arrival) {
    hop.on_ack(arrival.reception.from, ack.number);
    return true;
  }
  bool take(Hello hello, const Arrival& arrival) {
    if (!has_status) hellos.on_hello(arrival.reception.from, hello);
    return true;
  }
  bool take(ForwardAnt ant, const Arrival& arrival) {
    return ants.on_forward_ant(std::move(ant), arrival);
  }
  bool take(BackwardAnt ant, const Arrival& arrival) {
    return ants.on_backward_ant(std::move(ant), arrival);
  }
  bool take(Data data, const Arrival& arrival) {
    if (is_broadcast(data.header.destination)) {
      flooding.on_data(std::move(data));
    } else {
      forwarding.on_data(std::move(data), arrival.reception.from);
    }
    return true;
  }

  const bool has_status;
  HopAcknowledgement hop;
  Node node;
  RouteTable table;
  Hellos hellos;
  Neighbourhood neighbourhood{node.ports.timers, node.ports.observer};
  Outbox outbox{node, *this};
  Forwarding forwarding{node, table, outbox};
  Flooding flooding{node, outbox};
  Ants ants{node, table, outbox, forwarding};
};

Router::Router(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
               RouterPorts ports)
    : self_(self) {
  if (config.algorithm == Algorithm::kNone) {
    one_hop_ = std::make_unique<OneHop>(self, ports);
    return;
  }
  BARAKA_CHECK(is_valid(config));
  state_ = std::make_unique<State>(self, config, streams, ports);
}

Router::~Router() = default;

void Router::send(const Message& message) {
  BARAKA_CHECK(message.source == self_ && message.destination != message.source);
  BARAKA_CHECK(message.id != 0 && !message.topic.empty() && message.topic.size() <= kMaxTopic);
  BARAKA_CHECK(message.payload.size() <= kMaxPayload);
  if (one_hop_) {
    one_hop_->send(message);
  } else if (is_broadcast(message.destination)) {
    state_->flooding.send(message);
  } else {
    state_->forwarding.send(message);
  }
}

void Router::invalidate(std::string_view topic, AgentId destination) {
  if (state_) state_->table.remove(topic, destination);
}

std::vector<Route> Router::routes(std::string_view topic, AgentId destination) const {
  if (!state_) return {};
  return state_->table.routes(topic, destination);
}

std::vector<Route> Router::routes() const {
  if (!state_) return {};
  return state_->table.routes();
}

std::vector<Neighbour> Router::neighbours() const {
  return one_hop_ ? one_hop_->neighbours() : state_->neighbourhood.known();
}

void Router::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  const AgentId from = reception.from;
  if (from == self_ || is_broadcast(from) || !take_frame(reception, bytes)) ++malformed_;
}

bool Router::take_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  if (one_hop_) return one_hop_->on_frame(reception, bytes);
  auto frame = parse_frame(bytes);
  if (!frame) return false;
  state_->on_heard(reception);
  const Arrival arrival{reception, bytes.size()};
  return std::visit([&](auto& kind) { return state_->take(std::move(kind), arrival); }, *frame);
}

void Router::on_transmitted(const Transmission& transmission) {
  if (one_hop_) return one_hop_->on_transmitted(transmission);
  if (state_->has_status) state_->outbox.on_transmitted(transmission);
}

std::uint64_t Router::malformed_frames() const { return malformed_; }

}  // namespace hal::routing
