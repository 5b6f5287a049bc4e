#include "results/record/dds_values.h"

#include <algorithm>

namespace results::record {

using sim::air::SampleDelivery;
using sim::scenario::DdsSide;
using sim::scenario::DdsValue;

DdsValues::DdsValues(sim::air::Ledger& ledger, OnKnown on_known, OnEvent on_event)
    : ledger_(ledger), on_known_(std::move(on_known)), on_event_(std::move(on_event)) {
  ledger_.endpoints().set_on_told([this](sim::air::EndpointIndex endpoint) { learn(endpoint); });
  ledger_.samples().set_watcher(*this);
}

void DdsValues::know(bool Counts::*side, const Place& place, DdsSide name) {
  if (std::exchange(counts_[place].*side, true)) return;
  on_known_(place, name);
}

void DdsValues::learn(sim::air::EndpointIndex endpoint) {
  const sim::air::Endpoint& one = ledger_.endpoints().all()[endpoint];
  if (!one.agent || one.topic == 0) return;
  const Place place{*one.agent, one.topic};
  if (one.guid.entity.is_writer()) {
    know(&Counts::is_writer, place, DdsSide::kWriter);
  } else {
    know(&Counts::is_reader, place, DdsSide::kReader);
  }
  know(&Counts::is_transmitter, place, DdsSide::kTransmitter);
}

void DdsValues::find_transmitters() {
  const auto& accounts = ledger_.accounts().all();
  for (; accounts_ < accounts.size(); ++accounts_) {
    const sim::air::AirAccount& account = accounts[accounts_];
    if (account.kind.topic == 0) continue;
    const Place place{account.transmitter, account.kind.topic};
    counts_[place].accounts.push_back(accounts_);
    know(&Counts::is_transmitter, place, DdsSide::kTransmitter);
  }
}

double DdsValues::airtime(const Counts& counts) const {
  hal::Duration sum{};
  for (const std::size_t account : counts.accounts)
    sum += ledger_.accounts().all()[account].airtime;
  return hal::to_seconds(sum);
}

std::optional<double> DdsValues::value(hal::Time now, const Place& place, DdsValue value) const {
  const Counts& of = counts_.at(place);
  switch (value) {
    case DdsValue::kSent:
      return static_cast<double>(of.sent);
    case DdsValue::kSamples:
      return static_cast<double>(of.samples);
    case DdsValue::kDelivered:
      return static_cast<double>(of.delivered);
    case DdsValue::kDeliveredShare:
      if (of.samples == 0) return std::nullopt;
      return static_cast<double>(of.delivered) / static_cast<double>(of.samples);
    case DdsValue::kFirstTry:
      return static_cast<double>(of.first_try);
    case DdsValue::kRepaired:
      return static_cast<double>(of.delivered - of.first_try);
    case DdsValue::kRepairs:
      return static_cast<double>(of.repairs);
    case DdsValue::kLatency:
      return of.latency ? std::optional(hal::to_seconds(*of.latency)) : std::nullopt;
    case DdsValue::kAge:
      return of.newest ? std::optional(hal::to_seconds(now - *of.newest)) : std::nullopt;
    case DdsValue::kAirtime:
      return airtime(of);
    case DdsValue::kAirShare:
    case DdsValue::kCount:
      break;
  }
  return std::nullopt;
}

std::uint32_t DdsValues::topic_of(const SampleDelivery& sample) const {
  return ledger_.endpoints().all()[sample.writer].topic;
}

void DdsValues::on_sample_sent(hal::Time at, const SampleDelivery& sample, bool is_first) {
  const std::uint32_t topic = topic_of(sample);
  const auto& writers_agent = ledger_.endpoints().all()[sample.writer].agent;
  if (is_first && writers_agent) {
    ++counts_[{*writers_agent, topic}].sent;
    on_event_(at, {*writers_agent, topic}, DdsValue::kSent);
  }
  const Place place{sample.receiver, topic};
  ++counts_[place].samples;
  for (const DdsValue value : {DdsValue::kSamples, DdsValue::kDeliveredShare})
    on_event_(at, place, value);
}

void DdsValues::on_sample_repair(hal::Time at, const SampleDelivery& sample,
                                 std::uint32_t repairs) {
  const Place place{sample.receiver, topic_of(sample)};
  counts_[place].repairs += repairs;
  on_event_(at, place, DdsValue::kRepairs);
}

void DdsValues::on_sample_delivered(const SampleDelivery& sample) {
  const Place place{sample.receiver, topic_of(sample)};
  Counts& of = counts_[place];
  ++of.delivered;
  of.first_try += sample.is_repaired ? 0 : 1;
  of.latency = *sample.left - sample.entered;
  of.newest = std::max(of.newest.value_or(sample.entered), sample.entered);
  for (const DdsValue value :
       {DdsValue::kDelivered, DdsValue::kDeliveredShare, DdsValue::kLatency,
        sample.is_repaired ? DdsValue::kRepaired : DdsValue::kFirstTry, DdsValue::kAge}) {
    on_event_(*sample.left, place, value);
  }
}

}  // namespace results::record
