#include "sim/scenario/dds_value.h"

#include <algorithm>

#include "sim/radio/radio_config.h"

namespace sim::scenario {
namespace {

constexpr std::array<DdsValueKind, kDdsValues> kDdsValueKinds{{
    {DdsValue::kSent, "sent", "1",
     "samples of the topic that the agent's writers have sent so far while a reader at another "
     "agent was matched",
     DdsSide::kWriter},
    {DdsValue::kSamples, "samples", "1",
     "samples of the topic that other agents have sent to this agent so far while it had a "
     "matched reader",
     DdsSide::kReader},
    {DdsValue::kDelivered, "delivered", "1", "samples among these that have arrived completely",
     DdsSide::kReader},
    {DdsValue::kDeliveredShare, "delivered_share", "1",
     "delivered over samples; absent before the first sample", DdsSide::kReader},
    {DdsValue::kFirstTry, "first_try", "1",
     "delivered samples of which DDS had sent no part again when they were complete",
     DdsSide::kReader},
    {DdsValue::kRepaired, "repaired", "1", "the other delivered samples", DdsSide::kReader},
    {DdsValue::kRepairs, "repairs", "1",
     "samples, or RTPS fragments, that DDS has sent to this agent again so far", DdsSide::kReader},
    {DdsValue::kLatency, "latency", "s",
     "time of a sample from the interface of the writer's agent to that of this agent; an event",
     DdsSide::kReader},
    {DdsValue::kAge, "age", "s",
     "time since the newest sample that has arrived left the interface of the writer's agent; "
     "absent before the first",
     DdsSide::kReader},
    {DdsValue::kAirtime, "airtime", "s",
     "time on the air so far of the topic in frames of this agent, which may be the writer's "
     "(data, heartbeats), the reader's (acknowledgements) or an access point: its share of "
     "air_accounts",
     DdsSide::kTransmitter},
    {DdsValue::kAirShare, "air_share", "1",
     "that time on the air since the previous sample, over the time since then",
     DdsSide::kTransmitter},
}};

constexpr bool has_all_in_order() {
  for (std::size_t i = 0; i < kDdsValues; ++i) {
    const DdsValueKind& one = kDdsValueKinds[i];
    if (one.value != static_cast<DdsValue>(i) || one.name.empty()) return false;
  }
  return true;
}
static_assert(has_all_in_order());

bool is_access_point(const agents::AgentConfig& agent, const agents::SimulationConfig& config) {
  const radio::DcfConfig* const dcf = radio::dcf_of(config.radio);
  if (dcf == nullptr) return false;
  const auto names = [&agent](const std::vector<std::string>& access_points) {
    return std::ranges::find(access_points, agent.name) != access_points.end();
  };
  return names(dcf->bss.access_points) ||
         std::ranges::any_of(config.agents, [&names](const agents::AgentConfig& station) {
           return station.radio.access_points && names(*station.radio.access_points);
         });
}

}  // namespace

const std::array<DdsValueKind, kDdsValues>& dds_value_kinds() { return kDdsValueKinds; }

std::string dds_value_name(std::string_view topic, const DdsValueKind& kind) {
  return std::string(topic).append(".").append(kind.name);
}

bool has_dds(const agents::AgentConfig& agent, const agents::SimulationConfig& config,
             DdsSide side) {
  if (agent.network) return true;
  return side == DdsSide::kTransmitter && is_access_point(agent, config);
}

}  // namespace sim::scenario
