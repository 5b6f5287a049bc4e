#include "results/record/observables.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/check.h"
#include "sim/radio/mac/frame.h"

namespace results::record {
namespace {

template <class Source>
bool is_rate(const Source& source) {
  if (const auto* const quantity = std::get_if<sim::scenario::QuantityValue>(&source))
    return quantity->quantity->is_rate;
  const auto* const of = std::get_if<sim::scenario::TopicValue>(&source);
  return of != nullptr && of->value == sim::scenario::DdsValue::kAirShare;
}

bool is_of_events(sim::scenario::Tally tally) {
  return sim::scenario::tally_kinds()[static_cast<std::size_t>(tally)].is_of_events;
}

bool is_of_air(sim::scenario::DdsValue value) {
  return value == sim::scenario::DdsValue::kAirtime || value == sim::scenario::DdsValue::kAirShare;
}

bool is_for(const sim::radio::Frame& frame, hal::AgentId receiver) {
  return frame.receiver == receiver || hal::is_broadcast(frame.receiver);
}

hal::AgentId highest(const sim::agents::SimulationConfig& config) {
  hal::AgentId highest{};
  for (const sim::agents::AgentConfig& agent : config.agents) highest = std::max(highest, agent.id);
  return highest;
}

}  // namespace

Observables::Observables(std::vector<sim::scenario::ObservableRequest> requests,
                         Surroundings surroundings)
    : requests_(std::move(requests)),
      surroundings_(std::move(surroundings)),
      tables_(surroundings_.database) {
  for (const sim::scenario::ObservableRequest& request : requests_) {
    periods_.push_back({.every = request.every.value_or(hal::Duration{}),
                        .due = request.every ? hal::Time{} : hal::Time::max()});
  }
  for (const sim::agents::AgentConfig& agent : surroundings_.config.agents) {
    const std::vector<sim::scenario::Observable> all =
        sim::scenario::observables_of(agent, surroundings_.config);
    for (std::size_t i = 0; i < requests_.size(); ++i) add_matching(i, agent, all);
  }
  begin_dds();
}

void Observables::add_matching(std::size_t request, const sim::agents::AgentConfig& agent,
                               const std::vector<sim::scenario::Observable>& of_agent) {
  const auto pattern = sim::scenario::ObservablePattern::of(requests_[request].name);
  BARAKA_CHECK(pattern.has_value());
  if (!pattern->has_agent(agent.name)) return;
  for (const sim::scenario::Observable& one : of_agent) {
    if (one.domain == pattern->domain && pattern->has_value(one.value)) add(request, agent, one);
  }
}

void Observables::add(std::size_t request, const sim::agents::AgentConfig& agent,
                      const sim::scenario::Observable& observable) {
  const auto row = static_cast<std::int64_t>(watches_.size()) + 1;
  const ObservedValue::Identity identity{.row = row,
                                         .agent = agent.id,
                                         .name = observable.domain + "." + observable.value,
                                         .unit = observable.unit};
  watches_.push_back(
      std::make_unique<Watch>(Watch{.agent = agent.id,
                                    .on_change = !requests_[request].every,
                                    .source = observable.source,
                                    .kept = ObservedValue(tables_, requests_[request], identity)}));
  const std::size_t watch = watches_.size() - 1;
  if (requests_[request].every) periods_[request].watches.push_back(watch);
  sort_in(watch);
}

/// Adds a watch to the list by which it is found when something happens.
void Observables::sort_in(std::size_t watch) {
  const Watch& of = *watches_[watch];
  if (const auto* reading = std::get_if<sim::scenario::ReadingValue>(&of.source)) {
    readings_[{of.agent, reading->channel}].push_back(watch);
    return;
  }
  if (const auto* name = std::get_if<sim::scenario::RecordedValue>(&of.source)) {
    recorded_[of.agent][name->name].push_back(watch);
    return;
  }
  const auto* tally = std::get_if<sim::scenario::Tally>(&of.source);
  if (tally != nullptr) begin_tallies();
  const auto* topic = std::get_if<sim::scenario::TopicValue>(&of.source);
  if (topic != nullptr && of.on_change && !is_of_air(topic->value)) {
    of_topics_[{{of.agent, topic->topic}, topic->value}].push_back(watch);
    return;
  }
  if (!of.on_change) return;
  const bool happens = tally != nullptr && is_of_events(*tally);
  (happens ? events_[{of.agent, *tally}] : changing_[of.agent]).push_back(watch);
}

void Observables::begin_tallies() {
  if (tallies_) return;
  tallies_ = std::make_unique<Tallies>(
      highest(surroundings_.config),
      [this](hal::Time at, hal::AgentId agent, sim::scenario::Tally tally, double value) {
        const auto found = events_.find({agent, tally});
        if (found == events_.end()) return;
        for (const std::size_t one : found->second) keep(*watches_[one], at, value);
      });
}

std::optional<double> Observables::current(const Watch& watch, hal::Time at) const {
  if (const auto* of = std::get_if<sim::scenario::QuantityValue>(&watch.source)) {
    return surroundings_.simulation.read(*of->quantity, watch.agent, of->number);
  }
  if (const auto* tally = std::get_if<sim::scenario::Tally>(&watch.source)) {
    return tallies_->value(watch.agent, *tally);
  }
  if (const auto* of = std::get_if<sim::scenario::TopicValue>(&watch.source)) {
    const bool is_share = of->value == sim::scenario::DdsValue::kAirShare;
    return dds_->value(at, {watch.agent, of->topic},
                       is_share ? sim::scenario::DdsValue::kAirtime : of->value);
  }
  return watch.held;
}

/// The current value; for a rate, the mean rate since the last call.
std::optional<double> Observables::value(Watch& watch, hal::Time at) {
  const std::optional<double> now = current(watch, at);
  if (!is_rate(watch.source) || !now) return now;
  const auto from = std::exchange(watch.rate_from, std::pair{at, *now});
  if (!from || from->first >= at) return std::nullopt;
  return (*now - from->second) / hal::to_seconds(at - from->first);
}

void Observables::take_sample(Watch& watch, hal::Time at) {
  const std::optional<double> now = value(watch, at);
  if (now && !(watch.on_change && watch.seen == now)) keep(watch, at, *now);
}

void Observables::keep(Watch& watch, hal::Time at, double value) {
  watch.seen = value;
  const int rows = watch.kept.add(at, value);
  if (rows > 0) surroundings_.commits.on_rows(at, rows);
}

hal::Time Observables::due() const {
  hal::Time first = hal::Time::max();
  for (const Period& period : periods_) first = std::min(first, period.due);
  return first;
}

void Observables::look(hal::Time at) {
  if (dds_) dds_->find_transmitters();
  for (Period& period : periods_) {
    if (period.due > at) continue;
    for (const std::size_t watch : period.watches) take_sample(*watches_[watch], at);
    period.due = at + period.every;
  }
}

void Observables::finish(hal::Time end) {
  for (const auto& watch : watches_) watch->kept.finish(end);
}

bool Observables::observes(hal::AgentId agent, const hal::Channel& channel) const {
  return readings_.contains({agent, channel.name});
}

void Observables::on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                             std::span<const double> values) {
  for (const std::size_t one : readings_[{agent, channel.name}]) {
    Watch& watch = *watches_[one];
    const std::size_t index = std::get<sim::scenario::ReadingValue>(watch.source).index;
    const bool is_there = index < values.size() && std::isfinite(values[index]);
    watch.held = is_there ? std::optional<double>{values[index]} : std::nullopt;
    if (watch.on_change) take_sample(watch, at);
  }
}

void Observables::on_cycle(hal::Time at, hal::AgentId agent) {
  const auto found = changing_.find(agent);
  if (found == changing_.end()) return;
  for (const std::size_t watch : found->second) take_sample(*watches_[watch], at);
}

void Observables::on_frame_start(hal::Time, const sim::radio::Frame& frame) {
  if (!tallies_) return;
  using sim::radio::FrameType;
  using sim::scenario::Tally;
  const auto count = [&](Tally tally) { tallies_->count(frame.transmitter, tally); };
  count(Tally::kFramesSent);
  if (frame.retry) count(Tally::kRetries);
  tallies_->count(frame.transmitter, Tally::kAirtime, hal::to_seconds(frame.airtime));
  if (frame.qos) {
    const std::size_t category = hal::access_category(hal::Priority{frame.priority});
    count(of_category(Tally::kFramesBackground, category));
  }
  if (frame.type == FrameType::kBlockAck) count(Tally::kBlockAcks);
  if (frame.type == FrameType::kBlockAckRequest) count(Tally::kBlockAckRequests);
}

void Observables::on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                               hal::Verdict verdict, double rssi_dbm) {
  if (!tallies_ || !is_for(frame, receiver)) return;
  if (verdict == hal::Verdict::kDelivered) {
    tallies_->set(at, receiver, sim::scenario::Tally::kRssi, rssi_dbm);
  } else {
    tallies_->count(receiver, sim::scenario::Tally::kFramesLost);
  }
}

void Observables::on_delivered(hal::Time, const sim::radio::Frame&, hal::AgentId receiver) {
  if (tallies_) tallies_->count(receiver, sim::scenario::Tally::kFramesReceived);
}

void Observables::on_request_end(hal::Time, hal::AgentId sender, hal::AgentId,
                                 hal::Verdict verdict) {
  if (!tallies_ || verdict == hal::Verdict::kDelivered) return;
  tallies_->count(sender, sim::scenario::Tally::kRequestsFailed);
}

void Observables::on_message_sent(hal::Time at, const hal::Message& message) {
  if (tallies_) tallies_->on_message_sent(at, message);
}

void Observables::on_message_delivered(hal::Time at, hal::AgentId receiver,
                                       const hal::Message& message, int) {
  if (tallies_) tallies_->on_message_delivered(at, receiver, message);
}

void Observables::on_discovery(hal::Time at, hal::AgentId agent,
                               const sim::agents::Discovery& discovery) {
  if (!tallies_) return;
  tallies_->count(agent, discovery.found ? sim::scenario::Tally::kDiscoveries
                                         : sim::scenario::Tally::kDiscoveriesFailed);
  if (discovery.found) {
    tallies_->set(at, agent, sim::scenario::Tally::kDiscoveryTime, hal::to_seconds(discovery.took));
  }
}

void Observables::on_route_change(hal::Time, hal::AgentId agent, const hal::RouteChange&) {
  if (tallies_) tallies_->count(agent, sim::scenario::Tally::kRouteChanges);
}

void Observables::on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) {
  for (const std::size_t one : recorded(agent, name)) {
    Watch& watch = *watches_[one];
    watch.held = value;
    if (watch.on_change) keep(watch, at, value);
  }
}

/// A value that a controller records becomes known when it is recorded for the first time.
const Observables::Watches& Observables::recorded(hal::AgentId agent, std::string_view name) {
  auto& of_agent = recorded_[agent];
  const auto known = of_agent.find(name);
  if (known != of_agent.end()) return known->second;
  const std::string value(name);
  of_agent[value];  // also if nobody asked for it
  const sim::agents::AgentConfig& config = config_of(agent);
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    const auto pattern = sim::scenario::ObservablePattern::of(requests_[i].name);
    if (pattern->domain != sim::scenario::kControllersDomain) continue;
    if (!pattern->has_agent(config.name) || !pattern->has_value(value)) continue;
    add(i, config,
        {.domain = std::string(sim::scenario::kControllersDomain),
         .value = value,
         .unit = surroundings_.unit_of ? surroundings_.unit_of(agent, value) : "",
         .source = sim::scenario::RecordedValue{value}});
  }
  return of_agent[value];
}

}  // namespace results::record
