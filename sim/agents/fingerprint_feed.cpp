#include "sim/agents/fingerprint_feed.h"

#include <span>
#include <string_view>
#include <variant>

#include "sim/agents/ppdu_content.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/frame.h"

namespace sim::agents {
namespace {

namespace exchange = hal::node::exchange;

template <class Enum>
std::uint64_t number(Enum value) {
  return static_cast<std::uint64_t>(value);
}

void add(Fingerprint::Cell& hash, const hal::Bytes& bytes) {
  hash.add_bytes(bytes.data(), bytes.size());
}

void add(Fingerprint::Cell& hash, std::span<const double> values) {
  hash.add(std::uint64_t{values.size()});
  for (const double value : values) hash.add(value);
}

void add(Fingerprint::Cell& hash, const hal::Route& route) {
  hash.add(std::string_view{route.topic});
  hash.add(std::uint64_t{route.destination.value});
  hash.add(std::uint64_t{route.next_hop.value});
  hash.add(std::uint64_t{route.path.hops});
  hash.add(std::int64_t{route.path.delay.count()});
  hash.add(route.path.min_snr_db);
  hash.add(route.path.energy);
}

/// Only if there is one, so that fingerprints of messages without it do not change.
void add(Fingerprint::Cell& hash, hal::Priority priority) {
  if (priority != hal::Priority::kBestEffort) hash.add(std::uint64_t{hal::to_number(priority)});
}

void add(Fingerprint::Cell& hash, const hal::Message& message) {
  hash.add(std::uint64_t{message.source.value});
  hash.add(std::uint64_t{message.destination.value});
  hash.add(std::uint64_t{message.id});
  hash.add(std::string_view{message.topic});
  add(hash, message.payload);
  add(hash, message.priority);
}

void add_network(Fingerprint::Cell& hash, const hal::node::exchange::Event& event) {
  for (const hal::RouteChange& change : event.routes) {
    hash.add(std::uint64_t{change.removed});
    add(hash, change.route);
  }
  for (const hal::Neighbour& neighbour : event.neighbours) {
    hash.add(std::uint64_t{neighbour.id.value});
    hash.add(hal::to_ns(neighbour.last_heard));
    hash.add(neighbour.rssi_dbm);
  }
  for (const hal::AgentId lost : event.lost_neighbours) hash.add(std::uint64_t{lost.value});
}

/// Hashed values of an action, in this order. Fields that a kind of action does not have keep these
/// defaults, so that fingerprints do not change.
struct Ingredients {
  hal::Twist2 twist{};
  std::span<const double> wheel_speeds{};
  hal::MessageId message = 0;
  hal::AgentId destination{};
  std::string_view topic{};
  std::span<const std::uint8_t> payload{};
  hal::Priority priority{};
  hal::TimerId timer = 0;
  hal::Time at{};
  bool radio_on = true;
  hal::log::Level level = hal::log::Level::kInfo;
  std::string_view text{};
  std::optional<double> value{};
};

Ingredients ingredients_of(const exchange::DriveBody& body) { return {.twist = body.twist}; }
Ingredients ingredients_of(const exchange::DriveWheels& each) {
  return {.wheel_speeds = each.speeds};
}
Ingredients ingredients_of(const exchange::Send& message) {
  return {.message = message.id,
          .destination = message.destination,
          .topic = message.topic,
          .payload = message.payload,
          .priority = message.priority};
}
Ingredients ingredients_of(const exchange::Invalidate& routes) {
  return {.destination = routes.destination, .topic = routes.topic};
}
Ingredients ingredients_of(const exchange::SetTimer& timer) {
  return {.timer = timer.timer, .at = timer.at};
}
Ingredients ingredients_of(const exchange::SetRadio& radio) { return {.radio_on = radio.on}; }
Ingredients ingredients_of(const exchange::SetState& state) { return {.text = state.name}; }
Ingredients ingredients_of(const exchange::Log& line) {
  return {.level = line.level, .text = line.text};
}
Ingredients ingredients_of(const exchange::ControllerFailed& error) { return {.text = error.text}; }
Ingredients ingredients_of(const exchange::Record& record) {
  return {.at = record.at, .text = record.name, .value = record.value};
}

}  // namespace

void FingerprintFeed::on_frame_start(hal::Time at, const radio::Frame& frame) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kAir, frame.transmitter, at);
  hash.add(number(frame.type));
  hash.add(std::uint64_t{frame.receiver.value});
  hash.add(std::int64_t{frame.duration.count()});
  hash.add(std::uint64_t{frame.sequence});
  hash.add(std::uint64_t{frame.retry});
  hash.add(frame.rate.value);
  hash.add(std::uint64_t{frame.air_length});
  hash.add(std::uint64_t{frame.ethertype});
  add_payload(hash, frame);
  if (frame.group != 0) hash.add(frame.group);
  add_ppdu(hash, frame);
  if (!frame.is_of_bss()) return;
  hash.add(number(frame.ds));
  hash.add(std::uint64_t{frame.address3.value});
}

void FingerprintFeed::on_relay_lost(hal::Time at, hal::AgentId source,
                                    const radio::MacRequest& request, hal::Verdict verdict) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kAir, source, at);
  hash.add(std::uint64_t{request.destination.value});
  hash.add(number(verdict));
}

void FingerprintFeed::on_association(hal::Time at, hal::AgentId station,
                                     std::optional<hal::AgentId> access_point) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kAir, station, at);
  hash.add(std::uint64_t{access_point.has_value()});
  hash.add(std::uint64_t{access_point.value_or(hal::AgentId{}).value});
}

void FingerprintFeed::on_reception(hal::Time at, const radio::Frame& frame, hal::AgentId receiver,
                                   hal::Verdict verdict, double rssi_dbm) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kAir, receiver, at);
  hash.add(frame.id);
  hash.add(number(verdict));
  hash.add(rssi_dbm);
}

void FingerprintFeed::on_body(hal::Time at, hal::AgentId agent, const BodyState& body) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kBodies, agent, at);
  for (const double value : {body.x, body.y, body.theta, body.tilt}) hash.add(value);
}

/// All movables together: their agent is 0.
void FingerprintFeed::on_movable(hal::Time at, std::uint32_t number,
                                 const physics::BodyPose& pose) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kBodies, kWorld, at);
  hash.add(std::uint64_t{number});
  for (const double value : {pose.position.x, pose.position.y, pose.position.z}) hash.add(value);
  for (const double value : pose.quaternion) hash.add(value);
}

void FingerprintFeed::on_air_entered(hal::Time at, hal::AgentId agent,
                                     const radio::MacRequest& request) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kExchange, agent, at);
  hash.add(std::uint64_t{request.destination.value});
  hash.add(request.group);
  hash.add(std::uint64_t{request.ethertype});
  add(hash, *request.payload);
}

void FingerprintFeed::on_event(const hal::node::exchange::Event& event) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kExchange, event.agent, event.time);
  hash.add(number(event.cause()));
  for (const exchange::Reading& reading : event.readings) {
    hash.add(std::uint64_t{reading.channel});
    add(hash, reading.values);
  }
  if (const auto* arrived = std::get_if<exchange::MessageArrived>(&event.what))
    add(hash, arrived->message);
  // Hashed for every kind of event, so that fingerprints do not change.
  const auto* const due = std::get_if<exchange::TimerDue>(&event.what);
  const auto* const told = std::get_if<exchange::Notice>(&event.what);
  const exchange::Notice notice = told != nullptr ? *told : exchange::Notice{};
  hash.add(std::uint64_t{due != nullptr ? due->timer : 0});
  hash.add(std::uint64_t{notice.message});
  hash.add(number(notice.fate));
  add_network(hash, event);
}

void FingerprintFeed::on_action(hal::Time at, const hal::node::exchange::Action& action) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kExchange, action.agent, at);
  hash.add(std::uint64_t{action.what.index()});
  const Ingredients in =
      std::visit([](const auto& what) { return ingredients_of(what); }, action.what);
  for (const double value : {in.twist.vx, in.twist.vy, in.twist.omega}) hash.add(value);
  add(hash, in.wheel_speeds);
  hash.add(std::uint64_t{in.message});
  hash.add(std::uint64_t{in.destination.value});
  hash.add(in.topic);
  hash.add_bytes(in.payload.data(), in.payload.size());
  hash.add(std::uint64_t{in.timer});
  hash.add(hal::to_ns(in.at));
  hash.add(std::uint64_t{in.radio_on});
  hash.add(number(in.level));
  hash.add(in.text);
  if (in.value) hash.add(*in.value);
  add(hash, in.priority);
}

void FingerprintFeed::on_route_change(hal::Time at, hal::AgentId agent,
                                      const hal::RouteChange& change) {
  Fingerprint::Cell& hash = fingerprint_.at(Part::kRouting, agent, at);
  hash.add(std::uint64_t{change.removed});
  add(hash, change.route);
}

}  // namespace sim::agents
