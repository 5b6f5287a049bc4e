// The file is long because the handlers of AODV's messages call each other.
#include "hal/node/routing/aodv_routing.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include "hal/node/routing/frame_name.h"
#include "hal/node/routing/message_end.h"
#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

bool aodv_is_valid(const AodvConfig& c) {
  const auto is_octet = [](int value) { return value >= 1 && value <= 255; };
  return c.active_route_timeout > Duration::zero() && c.hello_interval > Duration::zero() &&
         c.node_traversal_time > Duration::zero() && c.allowed_hello_loss >= 1 &&
         c.local_add_ttl >= 0 && c.timeout_buffer >= 0 && c.rreq_retries >= 0 &&
         c.rerr_ratelimit >= 1 && c.rreq_ratelimit >= 1 && is_octet(c.net_diameter) &&
         is_octet(c.ttl_start) && is_octet(c.ttl_increment) && is_octet(c.ttl_threshold);
}

}  // namespace

AodvRouting::AodvRouting(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
                         const RouterPorts& ports)
    : hops_(self, config, streams, ports, *this),
      node_(hops_.node()),
      outbox_(hops_.outbox()),
      table_(node_),
      search_(node_, table_, outbox_,
              {.abandon = [this](const Transit& t, Verdict verdict) { end(t, verdict); },
               .repair_failed = [this](AgentId destination) { on_repair_failed(destination); }}),
      hellos_(node_, table_, search_, outbox_,
              [this](AgentId neighbour) { hops_.give_up(neighbour); }),
      flooding_(node_, outbox_),
      errors_(config.aodv.rerr_ratelimit),
      has_hellos_(config.aodv.hello && ports.link.capabilities().tx_status) {
  BARAKA_CHECK(aodv_is_valid(config.aodv) && config.buffer_age > Duration::zero());
  if (config.aodv.wait_after_start) {
    search_.hold_until(node_.now() + config.aodv.delete_period());
  }
  if (has_hellos_) hellos_.start();
}

bool AodvRouting::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  return hops_.on_frame(reception, bytes);
}

void AodvRouting::on_transmitted(const Transmission& transmission) {
  hops_.on_transmitted(transmission);
}

void AodvRouting::invalidate(std::string_view, AgentId destination) {
  if (table_.invalidate(destination, std::nullopt) != nullptr) {
    table_.forget_precursors(destination);
  }
}

std::vector<Route> AodvRouting::routes(std::string_view topic, AgentId destination) const {
  return table_.routes(topic, destination);
}

bool AodvRouting::on_packet(Packet packet, const Arrival& arrival) {
  const AgentId from = arrival.reception.from;
  hellos_.on_heard(from);
  if (auto* data = std::get_if<Data>(&packet)) {
    on_data(std::move(*data), from);
    return true;
  }
  const auto* control = std::get_if<Control>(&packet);
  const bool is_ours = control != nullptr && control->protocol == ControlOf::kAodv;
  return !is_ours || on_control(*control, from);
}

bool AodvRouting::on_control(const Control& control, AgentId from) {
  const auto packet = parse_aodv(control.body);
  if (!packet) return false;
  std::visit([&](const auto& message) { on_message(message, packet->ttl, from); }, packet->message);
  return true;
}

/// Section 6.5.
void AodvRouting::on_message(const Rreq& rreq, int ttl, AgentId from) {
  const auto banned = blacklist_.find(from);
  if (banned != blacklist_.end() && banned->second > node_.now()) {
    node_.count(ProtocolEvent::kRreqBlacklisted);
    return;
  }
  if (rreq.originator == node_.self) return;  // our own request, relayed by a neighbour
  table_.note_neighbour(from, node_.now() + node_.config.aodv.active_route_timeout);
  if (!requests_.note({rreq.originator, rreq.id}, node_.now()).second) return;

  const AodvConfig& config = node_.config.aodv;
  const int hops = rreq.hops + 1;
  // (R9)
  const Duration least = 2 * config.net_traversal_time() - 2 * hops * config.node_traversal_time;
  const Time until = node_.now() + std::max(Duration{1}, least);
  table_.offer({.destination = rreq.originator,
                .next_hop = from,
                .hops = hops,
                .sequence = rreq.originator_sequence,
                .expires = until});
  table_.use(rreq.originator, until);
  const bool is_answered = answer(rreq, from);
  on_route(from);
  on_route(rreq.originator);
  if (!is_answered && ttl > 1 && !search_.is_held()) relay(rreq, ttl - 1);
}

/// Section 6.6. @return whether the request needs no further handling.
bool AodvRouting::answer(const Rreq& rreq, AgentId from) {
  if (search_.is_held()) return false;
  if (rreq.destination == node_.self) {
    // Section 6.6.1, with what a node may have lost in a restart (section 6.1).
    if (rreq.destination_sequence) search_.raise_own_sequence(*rreq.destination_sequence);
    node_.count(ProtocolEvent::kRrepSent);
    send_reply(from,
               {.hops = 0,
                .destination = node_.self,
                .destination_sequence = search_.own_sequence(),
                .originator = rreq.originator,
                .lifetime = node_.config.aodv.my_route_timeout()},
               node_.config.aodv.net_diameter);
    return true;
  }
  const AodvEntry* const route = table_.active(rreq.destination);
  if (rreq.destination_only || route == nullptr || !route->sequence) return false;
  const bool is_old =
      rreq.destination_sequence && is_newer(*rreq.destination_sequence, *route->sequence);
  if (is_old || route->next_hop == from) return false;
  answer_for_other(rreq, *route, from);
  return true;
}

/// Sections 6.6.2 and 6.6.3.
void AodvRouting::answer_for_other(const Rreq& rreq, const AodvEntry& route, AgentId from) {
  const AgentId next_hop = route.next_hop;
  const Rrep reply{.hops = static_cast<std::uint8_t>(route.hops),
                   .destination = rreq.destination,
                   .destination_sequence = *route.sequence,
                   .originator = rreq.originator,
                   .lifetime = route.expires - node_.now()};
  table_.add_precursor(rreq.destination, from);
  table_.use(rreq.destination, node_.now());
  const AodvEntry* const back = table_.active(rreq.originator);
  if (back == nullptr) return;
  table_.add_precursor(rreq.originator, next_hop);
  node_.count(ProtocolEvent::kRrepSentForOther);
  const Rrep gratuitous{.hops = static_cast<std::uint8_t>(back->hops),
                        .destination = rreq.originator,
                        .destination_sequence = rreq.originator_sequence,
                        .originator = rreq.destination,
                        .lifetime = back->expires - node_.now()};
  send_reply(from, reply, node_.config.aodv.net_diameter);
  if (!rreq.gratuitous) return;
  node_.count(ProtocolEvent::kRrepGratuitous);
  send_reply(next_hop, gratuitous, node_.config.aodv.net_diameter);
}

void AodvRouting::relay(Rreq rreq, int ttl) {
  ++rreq.hops;
  const AodvEntry* const known = table_.find(rreq.destination);
  if (known != nullptr && known->sequence &&
      (!rreq.destination_sequence || is_newer(*known->sequence, *rreq.destination_sequence))) {
    rreq.destination_sequence = known->sequence;
  }
  const AodvPacket packet{.ttl = static_cast<std::uint8_t>(ttl), .message = rreq};
  node_.after_jitter([this, body = encode(packet)] {
    node_.count(ProtocolEvent::kRreqForwarded);
    hellos_.on_broadcast();
    outbox_.send_control(kEveryone, Control{ControlOf::kAodv, body});
  });
}

/// Sends a reply to a neighbour. If it is not acknowledged, the link is unidirectional (section
/// 6.8).
void AodvRouting::send_reply(AgentId to, const Rrep& rrep, int ttl) {
  const AodvPacket packet{.ttl = static_cast<std::uint8_t>(ttl), .message = rrep};
  outbox_.send_control(to, Control{ControlOf::kAodv, encode(packet)}, [this, to](Verdict verdict) {
    if (verdict != Verdict::kRetryLimit) return;
    node_.count(ProtocolEvent::kRrepLost);
    blacklist_[to] = node_.now() + node_.config.aodv.blacklist_timeout();
  });
}

/// Section 6.7; for a hello, section 6.9.
void AodvRouting::on_message(const Rrep& rrep, int ttl, AgentId from) {
  if (rrep.destination == node_.self) return;
  const AodvConfig& config = node_.config.aodv;
  const bool is_hello = rrep.destination == rrep.originator;
  if (is_hello && rrep.destination != from) return;
  table_.note_neighbour(from, node_.now() + config.active_route_timeout);
  if (is_hello) hellos_.on_hello(from);
  const AodvOffer offer{.destination = rrep.destination,
                        .next_hop = from,
                        .hops = rrep.hops + 1,
                        .sequence = rrep.destination_sequence,
                        .expires = node_.now() + std::max(rrep.lifetime, Duration{1})};
  const bool was_in_use = table_.is_in_use(from);
  (void)table_.offer(offer);
  if (is_hello) table_.set_in_use(from, was_in_use);
  on_route(from);
  if (is_hello) return;
  if (rrep.originator == node_.self) {
    node_.count(ProtocolEvent::kRrepReceived);
  } else if (ttl > 1) {
    relay(rrep, ttl - 1, from);
  }
  on_route(rrep.destination);
}

/// Forwards a reply if it matches the route in the table, whether it has just updated that route or
/// only confirms it. The RFC's wording forwards only replies that update the table; a search that
/// requires an answer of the destination would then end at a relay that already knew the route.
void AodvRouting::relay(Rrep rrep, int ttl, AgentId from) {
  const AodvEntry* const back = table_.active(rrep.originator);
  const AodvEntry* const route = table_.active(rrep.destination);
  if (back == nullptr || route == nullptr || !route->sequence || search_.is_held()) return;
  const bool is_ours = route->next_hop == from && route->hops == rrep.hops + 1 &&
                       *route->sequence == rrep.destination_sequence;
  if (!is_ours) return;
  const AgentId to = back->next_hop;
  const AgentId next_hop = route->next_hop;
  if (to == next_hop) return;
  table_.add_precursor(rrep.destination, to);
  table_.add_precursor(next_hop, to);
  table_.use(rrep.originator, node_.now() + node_.config.aodv.active_route_timeout);
  ++rrep.hops;
  node_.count(ProtocolEvent::kRrepForwarded);
  send_reply(to, rrep, ttl);
}

/// Section 6.11, case (iii).
void AodvRouting::on_message(const Rerr& rerr, int, AgentId from) {
  node_.count(ProtocolEvent::kRerrReceived);
  Unreachable broken;
  std::set<AgentId> listeners;
  for (const auto& [destination, sequence] : rerr.unreachable) {
    const AodvEntry* const route = table_.active(destination);
    if (route == nullptr || route->next_hop != from || destination == from) continue;
    // The route continues to work after a repair, but its users may search for a shorter one.
    if (rerr.no_delete) continue;
    const AodvEntry* const entry = table_.invalidate(destination, sequence);
    if (entry->precursors.empty()) continue;
    broken.emplace_back(destination, entry->sequence.value_or(0));
    listeners.insert(entry->precursors.begin(), entry->precursors.end());
    table_.forget_precursors(destination);
  }
  report(broken, listeners);
}

void AodvRouting::report(const Unreachable& broken, const std::set<AgentId>& listeners) {
  if (broken.empty() || listeners.empty()) return;
  if (errors_.next(node_.now()) > node_.now()) {
    node_.count(ProtocolEvent::kRerrSuppressed);
    return;
  }
  errors_.note(node_.now());
  node_.count(ProtocolEvent::kRerrSent);
  constexpr std::size_t kMost = 255;
  const auto end = broken.begin() + static_cast<std::ptrdiff_t>(std::min(broken.size(), kMost));
  const AodvPacket packet{
      .ttl = 1, .message = Rerr{.no_delete = false, .unreachable = {broken.begin(), end}}};
  const bool is_for_one = listeners.size() == 1;
  if (!is_for_one) hellos_.on_broadcast();
  outbox_.send_control(is_for_one ? *listeners.begin() : kEveryone,
                       Control{ControlOf::kAodv, encode(packet)});
}

/// Section 6.11, case (i).
void AodvRouting::on_no_answer(AgentId neighbour) {
  hellos_.forget(neighbour);
  Unreachable broken;
  std::set<AgentId> listeners;
  for (const AgentId destination : table_.via(neighbour)) {
    const AodvEntry before = *table_.find(destination);
    const AodvEntry* const entry = table_.invalidate(destination, std::nullopt);
    if (starts_repair(destination, before) || before.precursors.empty()) continue;
    broken.emplace_back(destination, entry->sequence.value_or(0));
    listeners.insert(before.precursors.begin(), before.precursors.end());
    table_.forget_precursors(destination);
  }
  listeners.erase(neighbour);
  report(broken, listeners);
}

/// Section 6.12: starts a repair if other nodes use the route and the destination was near.
bool AodvRouting::starts_repair(AgentId destination, const AodvEntry& before) {
  const AodvConfig& config = node_.config.aodv;
  const bool is_worth = config.local_repair && !before.precursors.empty() &&
                        before.hops <= config.max_repair_ttl() && !search_.is_held();
  if (!is_worth || !search_.repair(destination, before.hops + config.local_add_ttl)) return false;
  node_.count(ProtocolEvent::kLocalRepairStarted);
  table_.set_in_repair(destination, true);
  return true;
}

void AodvRouting::on_repair_failed(AgentId destination) {
  node_.count(ProtocolEvent::kLocalRepairFailed);
  table_.set_in_repair(destination, false);
  const AodvEntry* const entry = table_.find(destination);
  if (entry == nullptr || entry->is_valid) return;
  report({{destination, entry->sequence.value_or(0)}}, entry->precursors);
  table_.forget_precursors(destination);
}

void AodvRouting::send(const Message& message) {
  table_.note_class(message.topic);
  Transit transit = to_transit(node_, message);
  if (is_broadcast(message.destination)) {
    hellos_.on_broadcast();
    outbox_.send_message(kEveryone, std::move(transit));
  } else {
    forward(std::move(transit));
  }
}

void AodvRouting::on_data(Data data, AgentId from) {
  const Header& header = data.header;
  if (is_broadcast(header.destination)) return flooding_.on_data(std::move(data));
  if (header.destination == node_.self) {
    if (!delivered_.note({header.source, header.sequence}, node_.now()).second) return;
    refresh(data, from);
    return deliver(node_, std::move(data));
  }
  const auto key = std::make_tuple(header.source, header.sequence, data.transmissions);
  if (!relayed_.note(key, node_.now()).second) return;
  table_.note_class(header.topic);
  refresh(data, from);
  Transit transit{.data = std::move(data), .came_from = from, .owes_fate = false};
  if (!search_.is_held()) return forward(std::move(transit));
  // Section 6.13: other nodes still use routes through this node from before its restart.
  search_.hold_until(node_.now() + node_.config.aodv.delete_period());
  refuse(transit);
}

/// Section 6.2: using a route extends its lifetime, in both directions.
void AodvRouting::refresh(const Data& data, AgentId from) {
  const Time until = node_.now() + node_.config.aodv.active_route_timeout;
  table_.use(data.header.source, until);
  table_.use(from, until);
}

void AodvRouting::forward(Transit transit) {
  const AgentId destination = transit.data.header.destination;
  if (transit.data.transmissions >= node_.config.hop_limit) {
    return end(transit, Verdict::kExpired);
  }
  const AodvEntry* const route = table_.active(destination);
  if (route == nullptr) return refuse(transit);
  const AgentId next_hop = route->next_hop;
  const Time until = node_.now() + node_.config.aodv.active_route_timeout;
  if (transit.came_from) table_.add_precursor(destination, *transit.came_from);
  table_.use(destination, until);
  table_.use(next_hop, until);
  outbox_.send_message(next_hop, std::move(transit));
}

/// Without a route, a message of this node, or one to a destination under repair, waits; otherwise
/// section 6.11, case (ii).
void AodvRouting::refuse(const Transit& transit) {
  const AgentId destination = transit.data.header.destination;
  const AodvEntry* const known = table_.find(destination);
  if (!transit.came_from || (known != nullptr && known->is_in_repair)) {
    return search_.wait(transit);
  }
  const AodvSequence sequence = known != nullptr ? known->sequence.value_or(0) : 0;
  report({{destination, sequence}}, {*transit.came_from});
  end(transit, Verdict::kNoRoute);
}

void AodvRouting::end(const Transit& transit, Verdict verdict) {
  end_message(node_, transit, verdict);
}

void AodvRouting::on_sent(Transit transit, Verdict verdict) {
  if (is_broadcast(transit.data.header.destination)) {
    return flooding_.on_sent(transit, verdict);
  }
  if (verdict == Verdict::kDelivered) return hand_over(node_, transit);
  const AodvEntry* const known = table_.find(transit.data.header.destination);
  const bool may_wait = !transit.came_from || (known != nullptr && known->is_in_repair);
  if (verdict == Verdict::kRetryLimit && may_wait) return forward(std::move(transit));
  end(transit, verdict);
}

void AodvRouting::on_route(AgentId destination) {
  if (table_.active(destination) == nullptr) return;
  for (Transit& transit : search_.on_route(destination)) forward(std::move(transit));
}

constexpr std::array kAodvEvents{
    ProtocolEvent::kHelloSent,          ProtocolEvent::kFloodRelayed,
    ProtocolEvent::kFloodCopyDropped,   ProtocolEvent::kRreqSent,
    ProtocolEvent::kRreqForwarded,      ProtocolEvent::kRreqDelayed,
    ProtocolEvent::kRrepSent,           ProtocolEvent::kRrepSentForOther,
    ProtocolEvent::kRrepGratuitous,     ProtocolEvent::kRrepForwarded,
    ProtocolEvent::kRrepReceived,       ProtocolEvent::kRrepLost,
    ProtocolEvent::kRreqBlacklisted,    ProtocolEvent::kRerrSent,
    ProtocolEvent::kRerrReceived,       ProtocolEvent::kRerrSuppressed,
    ProtocolEvent::kLocalRepairStarted, ProtocolEvent::kLocalRepairDone,
    ProtocolEvent::kLocalRepairFailed};

constinit const ProtocolKind kAodvKind{
    .name = "aodv",
    .make = make_as<AodvRouting>,
    .name_frame =
        [](const SentFrame& frame) {
          return frame_name(frame.bytes, [](const Control& control) -> std::string_view {
            if (control.protocol != ControlOf::kAodv) return {};
            const auto packet = parse_aodv(control.body);
            return packet ? name_of(packet->message) : std::string_view();
          });
        },
    // There is only one next hop.
    .weigh = [](const RoutingConfig&, const Route&) -> std::optional<double> { return 1; },
    .events = kAodvEvents};

}  // namespace hal::node::routing
