// The values of DDS topics among the observables.
#include <algorithm>

#include "results/record/observables.h"

namespace results::record {

using sim::scenario::DdsValue;
using sim::scenario::ObservablePattern;

void Observables::begin_dds() {
  const auto is_of_topics = [](const sim::scenario::ObservableRequest& request) {
    return ObservablePattern::of(request.name)->domain == sim::scenario::kDdsDomain;
  };
  if (surroundings_.ledger == nullptr || std::ranges::none_of(requests_, is_of_topics)) return;
  dds_ = std::make_unique<DdsValues>(
      *surroundings_.ledger,
      [this](const DdsValues::Place& place, sim::scenario::DdsSide side) {
        add_topic(place, side);
      },
      [this](hal::Time at, const DdsValues::Place& place, DdsValue value) {
        on_dds(at, place, value);
      });
}

const sim::agents::AgentConfig& Observables::config_of(hal::AgentId agent) const {
  return *std::ranges::find(surroundings_.config.agents, agent, &sim::agents::AgentConfig::id);
}

/// A topic has become known at an agent.
void Observables::add_topic(const DdsValues::Place& place, sim::scenario::DdsSide side) {
  const sim::agents::AgentConfig& agent = config_of(place.first);
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    const auto pattern = ObservablePattern::of(requests_[i].name);
    if (pattern->domain != sim::scenario::kDdsDomain || !pattern->has_agent(agent.name)) continue;
    for (const sim::scenario::DdsValueKind& kind : sim::scenario::dds_value_kinds()) {
      const std::string name = dds_value_name(dds_->topic(place.second), kind);
      if (kind.side != side || !pattern->has_value(name)) continue;
      add(i, agent,
          {.domain = std::string(sim::scenario::kDdsDomain),
           .value = name,
           .unit = std::string(kind.unit),
           .source = sim::scenario::TopicValue{place.second, kind.value}});
    }
  }
}

void Observables::on_dds(hal::Time at, const DdsValues::Place& place, DdsValue value) {
  const auto found = of_topics_.find({place, value});
  if (found == of_topics_.end()) return;
  for (const std::size_t one : found->second) {
    if (value != DdsValue::kLatency) {
      take_sample(*watches_[one], at);
    } else if (const auto latency = dds_->value(at, place, value)) {
      keep(*watches_[one], at, *latency);
    }
  }
}

}  // namespace results::record
