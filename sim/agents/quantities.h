#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/types/time.h"
#include "sim/agents/simulation_config.h"

namespace sim::radio {
class MacSap;
}

namespace sim::agents {

class AgentPositions;
class Scene;
class SimulatedMote;

/// Read access to one agent of a run, for the table of quantities.
struct AgentView {
  const SimulatedMote& agent;
  Scene& scene;  ///< May update its caches; nothing else changes.
  const AgentPositions& positions;
  const radio::MacSap& mac;
  hal::Time now{};
};

/// A number of an agent that can be read at any time without changing anything: its true state and
/// that of its radio and router.
struct Quantity {
  std::string_view domain;  ///< "agents", "radio", "routing"
  std::string_view name;    ///< "x", "queue"; for a family without the number.
  std::string_view unit;    ///< "m", "s", "1"; of a rate, that of `read`.
  std::string_view meaning;
  /// Its value is the increase per second of what is read, between two samples.
  bool is_rate = false;
  /// Whether an agent has it; for a family, whether it has the member with this number, from 0.
  bool (*has)(const AgentConfig& agent, std::size_t number) = nullptr;
  /// nullopt: no value now, as for the body of an agent that is not present.
  std::optional<double> (*read)(const AgentView& view, std::size_t number) = nullptr;
  bool is_family = false;  ///< Each agent has members numbered from 0.
};

/// All quantities, grouped by domain.
const std::vector<Quantity>& quantities();

}  // namespace sim::agents
