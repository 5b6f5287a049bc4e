#include <variant>

#include "gateway/exchange/convert.h"
#include "gateway/exchange/ranges.h"

namespace gateway::exchange {
namespace {

static_assert(static_cast<int>(hal::node::exchange::Cause::kStop) == static_cast<int>(wire::STOP));
static_assert(static_cast<int>(hal::node::exchange::Cause::kLink) == static_cast<int>(wire::LINK));
static_assert(static_cast<int>(hal::Fate::kFailed) == static_cast<int>(wire::FAILED));

void to_wire(const hal::node::exchange::Reading& reading, wire::Reading& out) {
  out.channel(reading.channel);
  out.lost(reading.lost);
  out.values(reading.values);
}

void from_wire(const wire::Reading& reading, hal::node::exchange::Reading& out) {
  out.channel = reading.channel();
  out.lost = reading.lost();
  out.values = reading.values();
}

void to_wire(const hal::Message& message, wire::Message& out) {
  out.source(message.source.value);
  out.destination(message.destination.value);
  out.id(message.id);
  out.topic(message.topic);
  out.payload(message.payload);
  out.priority(hal::to_number(message.priority));
}

hal::Message from_wire(const wire::Message& message) {
  return {hal::AgentId{message.source()},
          hal::AgentId{message.destination()},
          message.id(),
          message.topic(),
          message.payload(),
          hal::Priority{message.priority()}};
}

void to_wire(const hal::RouteChange& change, wire::RouteChange& out) {
  out.topic(change.route.topic);
  out.destination(change.route.destination.value);
  out.next_hop(change.route.next_hop.value);
  out.hops(change.route.path.hops);
  out.delay(change.route.path.delay.count());
  out.min_snr_db(change.route.path.min_snr_db);
  out.energy(change.route.path.energy);
  out.removed(change.removed);
}

void from_wire(const wire::RouteChange& change, hal::RouteChange& out) {
  const hal::PathStatistics path{change.hops(), hal::Duration{change.delay()}, change.min_snr_db(),
                                 change.energy()};
  out.route = {change.topic(), hal::AgentId{change.destination()}, hal::AgentId{change.next_hop()},
               path};
  out.removed = change.removed();
}

void to_wire(const hal::Neighbour& neighbour, wire::Neighbour& out) {
  out.id(neighbour.id.value);
  out.last_heard(hal::to_ns(neighbour.last_heard));
  out.rssi_dbm(neighbour.rssi_dbm);
}

void from_wire(const wire::Neighbour& neighbour, hal::Neighbour& out) {
  out = {hal::AgentId{neighbour.id()}, hal::time_from_ns(neighbour.last_heard()),
         neighbour.rssi_dbm()};
}

void to_wire(hal::AgentId agent, std::uint16_t& out) { out = agent.value; }
void from_wire(std::uint16_t agent, hal::AgentId& out) { out.value = agent; }

/// Converts element by element, reusing the memory of `out`.
template <class In, class Out>
void all_to_wire(const std::vector<In>& in, std::vector<Out>& out) {
  out.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) to_wire(in[i], out[i]);
}
template <class In, class Out>
void all_from_wire(const std::vector<In>& in, std::vector<Out>& out) {
  out.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) from_wire(in[i], out[i]);
}

/// Converts the cause of an event. Members that the cause does not use are as in a new sample.
void to_wire(const hal::node::exchange::Event::What& what, wire::Event& out) {
  const auto* const arrived = std::get_if<hal::node::exchange::MessageArrived>(&what);
  const auto* const due = std::get_if<hal::node::exchange::TimerDue>(&what);
  const auto* const told = std::get_if<hal::node::exchange::Notice>(&what);
  const auto notice = told != nullptr ? *told : hal::node::exchange::Notice{};
  out.cause(static_cast<wire::Cause>(what.index()));
  out.message().resize(arrived != nullptr ? 1 : 0);
  if (arrived != nullptr) to_wire(arrived->message, out.message()[0]);
  out.timer(due != nullptr ? due->timer : 0);
  out.noticed(notice.message);
  out.fate(static_cast<wire::Fate>(notice.fate));
}

hal::node::exchange::Event::What what_of(const wire::Event& event, Ranges& ranges) {
  const bool has_message = event.cause() == wire::MESSAGE;
  const hal::Fate fate = ranges.enumerator(event.fate(), hal::Fate::kFailed, "fate");
  if (!ranges.is_known(event.cause(), wire::STOP, "cause") ||
      !ranges.exactly(event.message().size(), has_message ? 1 : 0, "messages")) {
    return {};
  }
  switch (event.cause()) {
    case wire::START:
      return hal::node::exchange::Start{};
    case wire::MESSAGE:
      return hal::node::exchange::MessageArrived{from_wire(event.message()[0])};
    case wire::TIMER:
      return hal::node::exchange::TimerDue{event.timer()};
    case wire::NOTICE:
      return hal::node::exchange::Notice{event.noticed(), fate};
    case wire::LINK:
      return hal::node::exchange::LinkChanged{};
    case wire::CONTROL:
      return hal::node::exchange::ControlDue{};
    case wire::STOP:
      return hal::node::exchange::Stop{};
  }
  return {};
}

void to_wire(const hal::node::exchange::Event& event, wire::Event& out) {
  out.agent(event.agent.value);
  out.time(hal::to_ns(event.time));
  to_wire(event.what, out);
  all_to_wire(event.readings, out.readings());
  const bool has_changes =
      !event.routes.empty() || !event.neighbours.empty() || !event.lost_neighbours.empty();
  out.network().resize(has_changes ? 1 : 0);
  if (!has_changes) return;
  wire::NetworkChanges& network = out.network()[0];
  all_to_wire(event.routes, network.routes());
  all_to_wire(event.neighbours, network.neighbours());
  all_to_wire(event.lost_neighbours, network.lost_neighbours());
}

void from_wire(const wire::Event& event, Ranges& ranges, hal::node::exchange::Event& out) {
  out.agent = hal::AgentId{event.agent()};
  out.time = hal::time_from_ns(event.time());
  out.what = what_of(event, ranges);
  all_from_wire(event.readings(), out.readings);
  ranges.at_most(event.network().size(), 1, "changes of the network");
  static const wire::NetworkChanges none;
  const wire::NetworkChanges& network = event.network().empty() ? none : event.network()[0];
  all_from_wire(network.routes(), out.routes);
  all_from_wire(network.neighbours(), out.neighbours);
  all_from_wire(network.lost_neighbours(), out.lost_neighbours);
}

}  // namespace

void to_wire(const hal::node::exchange::Step& step, wire::Step& out) {
  out.server(step.server);
  out.run(step.run);
  out.sequence_number(step.sequence);
  out.until(hal::to_ns(step.until));
  out.events().resize(step.events.size());
  for (std::size_t i = 0; i < step.events.size(); ++i) to_wire(step.events[i], out.events()[i]);
}

hal::Result<void> from_wire(const wire::Step& step, hal::node::exchange::Step& out) {
  out.server = step.server();
  out.run = step.run();
  out.sequence = step.sequence_number();
  out.until = hal::time_from_ns(step.until());
  out.events.resize(step.events().size());
  for (std::size_t i = 0; i < out.events.size(); ++i) {
    Ranges ranges;
    from_wire(step.events()[i], ranges, out.events[i]);
    if (auto good = ranges.check(); !good)
      return malformed("event", i, step.events()[i].agent(), good.error());
  }
  return {};
}

}  // namespace gateway::exchange
