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

/// One agent of a run under way, to be read. For the table of quantities.
struct AgentView {
  const SimulatedMote& agent;
  Scene& scene;  ///< Remembers what it was asked; nothing else changes.
  const AgentPositions& positions;
  const radio::MacSap& mac;
  hal::Time now{};
};

/// A number of each agent that can be read at any instant without changing anything: its true state
/// and that of its radio and router.
struct Quantity {
  std::string_view domain;  ///< "agents", "radio", "routing"
  std::string_view name;    ///< "x", "queue"; of a family without its number
  std::string_view unit;    ///< "m", "s", "1"; of a rate that of its value
  std::string_view meaning;
  /// Its value is by how much what is read grows per second, between two looks.
  bool is_rate = false;
  /// Whether an agent has it; of a family, has it with this number from 0.
  bool (*has)(const AgentConfig& agent, std::size_t number) = nullptr;
  /// None: it does not have it now, as an agent that is not present has no body.
  std::optional<double> (*read)(const AgentView& view, std::size_t number) = nullptr;
  bool is_family = false;  ///< Each agent has it with the numbers from 0.
};

/// All of them, domain by domain.
const std::vector<Quantity>& quantities();

}  // namespace sim::agents
