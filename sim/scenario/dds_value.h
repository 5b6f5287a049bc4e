#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/agents/simulation_config.h"

namespace sim::scenario {

inline constexpr std::string_view kDdsDomain = "dds";

/// Values of a DDS topic at one agent. Add a new one before kCount, with its row in dds_value.cpp.
enum class DdsValue : std::uint8_t {
  kSent,
  kSamples,
  kDelivered,
  kDeliveredShare,
  kFirstTry,
  kRepaired,
  kRepairs,
  kLatency,
  kAge,
  kAirtime,
  kAirShare,
  kCount,
};
inline constexpr std::size_t kDdsValues = static_cast<std::size_t>(DdsValue::kCount);

/// Which agents have a value of a topic.
enum class DdsSide : std::uint8_t {
  kWriter,       ///< Its programs contain a writer of the topic.
  kReader,       ///< Its programs contain a reader of the topic.
  kTransmitter,  ///< Either of these, or its radio has sent something of the topic.
};

struct DdsValueKind {
  DdsValue value;
  std::string_view name, unit, meaning;
  DdsSide side;
};

/// All kinds, in the order of the enumeration.
const std::array<DdsValueKind, kDdsValues>& dds_value_kinds();

/// Name of a value of a topic, without its domain: "rt/scan.latency".
std::string dds_value_name(std::string_view topic, const DdsValueKind& kind);

/// Whether an agent can have values of that side: its programs have a network or, for kTransmitter,
/// it is an access point.
bool has_dds(const agents::AgentConfig& agent, const agents::SimulationConfig& config,
             DdsSide side);

}  // namespace sim::scenario
