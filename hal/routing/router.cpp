#include "hal/routing/router.h"

#include <variant>

#include "hal/routing/ants.h"
#include "hal/routing/flooding.h"
#include "hal/routing/neighbourhood.h"
#include "hal/types/check.h"

namespace hal::routing {
namespace {

/// Whether every value is in the range its comment gives.
bool is_valid(const RoutingConfig& config) {
  return config.beta >= 1 && config.direct_weight > 0 && config.jitter_max >= Duration::zero() &&
         config.retry_period > Duration::zero() && config.retries >= 1 && config.acceptance >= 1 &&
         config.hop_limit >= 1 && config.hop_limit <= static_cast<int>(kMaxPath) &&
         config.buffer_age > Duration::zero();
}

}  // namespace

/// The parts of a router, and the way of a frame between them.
struct Router::State final : OutboxListener {
  State(AgentId self, const RoutingConfig& config, RandomStream random, RouterPorts ports)
      : node{self, config, random, ports, OwnTimers(ports.timers)}, table(ports.observer) {}

  void on_no_answer(AgentId neighbour) override {
    table.remove_via(neighbour);
    neighbourhood.on_no_answer(neighbour);
  }

  void on_sent(Transit transit, Verdict verdict) override {
    if (transit.data.header.destination == kEveryone) {
      flooding.on_sent(transit, verdict);
    } else {
      forwarding.on_sent(std::move(transit), verdict);
    }
  }

  bool take(ForwardAnt ant, const Arrival& arrival) {
    return ants.on_forward_ant(std::move(ant), arrival);
  }
  bool take(BackwardAnt ant, const Arrival& arrival) {
    return ants.on_backward_ant(std::move(ant), arrival);
  }
  bool take(Data data, const Arrival& arrival) {
    if (data.header.destination == kEveryone) {
      flooding.on_data(std::move(data));
    } else {
      forwarding.on_data(std::move(data), arrival.reception.from);
    }
    return true;
  }

  Node node;
  RouteTable table;
  Neighbourhood neighbourhood{node};
  Outbox outbox{node, *this};
  Forwarding forwarding{node, table, outbox};
  Flooding flooding{node, outbox};
  Ants ants{node, table, outbox, forwarding};
  std::uint64_t malformed = 0;
};

Router::Router(AgentId self, const RoutingConfig& config, RandomStream random, RouterPorts ports) {
  BARAKA_CHECK(is_valid(config));
  state_ = std::make_unique<State>(self, config, random, ports);
}

Router::~Router() = default;

void Router::send(const Message& message) {
  BARAKA_CHECK(message.source == state_->node.self && message.destination != message.source);
  BARAKA_CHECK(message.id != 0 && !message.topic.empty() && message.topic.size() <= kMaxTopic);
  BARAKA_CHECK(message.payload.size() <= kMaxPayload);
  if (message.destination == kEveryone) {
    state_->flooding.send(message);
  } else {
    state_->forwarding.send(message);
  }
}

void Router::invalidate(std::string_view topic, AgentId destination) {
  state_->table.remove(topic, destination);
}

std::vector<Route> Router::routes(std::string_view topic, AgentId destination) const {
  return state_->table.routes(topic, destination);
}

void Router::on_frame(const Reception& reception, std::span<const std::uint8_t> frame) {
  state_->neighbourhood.on_heard(reception);
  auto packet = parse(frame);
  const Arrival arrival{reception, frame.size()};
  const bool is_good =
      packet &&
      std::visit([&](auto& kind) { return state_->take(std::move(kind), arrival); }, *packet);
  if (!is_good) ++state_->malformed;
}

void Router::on_transmitted(const Transmission& transmission) {
  state_->outbox.on_transmitted(transmission);
}

std::uint64_t Router::malformed_frames() const { return state_->malformed; }

}  // namespace hal::routing
