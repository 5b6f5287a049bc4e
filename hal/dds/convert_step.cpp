#include "hal/dds/convert.h"
#include "hal/dds/ranges.h"

namespace hal::dds {
namespace {

static_assert(static_cast<int>(exchange::Cause::kStop) == static_cast<int>(wire::STOP));
static_assert(static_cast<int>(exchange::Cause::kLink) == static_cast<int>(wire::LINK));
static_assert(static_cast<int>(Fate::kFailed) == static_cast<int>(wire::FAILED));

wire::Reading to_wire(const exchange::Reading& reading) {
  wire::Reading out;
  out.channel(reading.channel);
  out.values(reading.values);
  return out;
}

wire::Message to_wire(const Message& message) {
  wire::Message out;
  out.source(message.source.value);
  out.destination(message.destination.value);
  out.id(message.id);
  out.topic(message.topic);
  out.payload(message.payload);
  return out;
}

Message from_wire(const wire::Message& message) {
  return {AgentId{message.source()}, AgentId{message.destination()}, message.id(), message.topic(),
          message.payload()};
}

wire::RouteChange to_wire(const RouteChange& change) {
  wire::RouteChange out;
  out.topic(change.route.topic);
  out.destination(change.route.destination.value);
  out.next_hop(change.route.next_hop.value);
  out.hops(change.route.path.hops);
  out.delay(change.route.path.delay.count());
  out.min_snr_db(change.route.path.min_snr_db);
  out.energy(change.route.path.energy);
  out.removed(change.removed);
  return out;
}

RouteChange from_wire(const wire::RouteChange& change) {
  const PathStatistics path{change.hops(), Duration{change.delay()}, change.min_snr_db(),
                            change.energy()};
  return {{change.topic(), AgentId{change.destination()}, AgentId{change.next_hop()}, path},
          change.removed()};
}

wire::Neighbour to_wire(const Neighbour& neighbour) {
  wire::Neighbour out;
  out.id(neighbour.id.value);
  out.last_heard(to_ns(neighbour.last_heard));
  out.rssi_dbm(neighbour.rssi_dbm);
  return out;
}

Neighbour from_wire(const wire::Neighbour& neighbour) {
  return {AgentId{neighbour.id()}, time_from_ns(neighbour.last_heard()), neighbour.rssi_dbm()};
}

wire::Event to_wire(const exchange::Event& event) {
  wire::Event out;
  out.agent(event.agent.value);
  out.time(to_ns(event.time));
  out.cause(static_cast<wire::Cause>(event.cause));
  for (const exchange::Reading& reading : event.readings) {
    out.readings().push_back(to_wire(reading));
  }
  out.has_message(event.message.has_value());
  if (event.message) out.message(to_wire(*event.message));
  out.timer(event.timer);
  out.noticed(event.noticed);
  out.fate(static_cast<wire::Fate>(event.fate));
  for (const RouteChange& change : event.routes) out.routes().push_back(to_wire(change));
  for (const Neighbour& neighbour : event.neighbours) {
    out.neighbours().push_back(to_wire(neighbour));
  }
  for (const AgentId lost : event.lost_neighbours) out.lost_neighbours().push_back(lost.value);
  return out;
}

exchange::Event from_wire(const wire::Event& event, Ranges& ranges) {
  exchange::Event out;
  out.agent = AgentId{event.agent()};
  out.time = time_from_ns(event.time());
  out.cause = ranges.enumerator(event.cause(), exchange::Cause::kStop, "cause");
  for (const wire::Reading& reading : event.readings()) {
    out.readings.push_back({reading.channel(), reading.values()});
  }
  if (event.has_message()) out.message = from_wire(event.message());
  out.timer = event.timer();
  out.noticed = event.noticed();
  out.fate = ranges.enumerator(event.fate(), Fate::kFailed, "fate");
  for (const wire::RouteChange& change : event.routes()) out.routes.push_back(from_wire(change));
  for (const wire::Neighbour& neighbour : event.neighbours()) {
    out.neighbours.push_back(from_wire(neighbour));
  }
  for (const std::uint16_t lost : event.lost_neighbours()) {
    out.lost_neighbours.push_back(AgentId{lost});
  }
  return out;
}

}  // namespace

wire::Step to_wire(const exchange::Step& step) {
  wire::Step out;
  out.server(step.server);
  out.run(step.run);
  out.sequence_number(step.sequence);
  out.until(to_ns(step.until));
  out.events().reserve(step.events.size());
  for (const exchange::Event& event : step.events) out.events().push_back(to_wire(event));
  return out;
}

Result<exchange::Step> from_wire(const wire::Step& step) {
  Ranges ranges;
  exchange::Step out;
  out.server = step.server();
  out.run = step.run();
  out.sequence = step.sequence_number();
  out.until = time_from_ns(step.until());
  out.events.reserve(step.events().size());
  for (const wire::Event& event : step.events()) out.events.push_back(from_wire(event, ranges));
  if (auto checked = ranges.check(); !checked) return tl::unexpected(checked.error());
  return out;
}

}  // namespace hal::dds
