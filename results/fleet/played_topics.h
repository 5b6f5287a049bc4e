#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "results/fleet/sample_measure.h"

namespace results::fleet {

using AgentNames = std::map<std::int64_t, std::string>;  ///< By address.

/// What an agent's player of `topics` was told, and did.
struct PlayedTopics {
  std::string agent;
  std::map<std::string, WriterPlan> writes;  ///< By topic.
  std::set<std::string> reads;
};

/// Reads the plans and the journals that the players left in the folder of a run.
/// @param end_s  of the run. @return empty: no agent has `topics`.
/// @throws std::runtime_error  a file cannot be read; the message names it.
std::vector<PlayedTopics> read_players(const std::filesystem::path& folder, const AgentNames& names,
                                       double end_s);

}  // namespace results::fleet
