#pragma once

#include <filesystem>
#include <vector>

#include "sim/agents/real_time.h"

namespace sim::record {

/// What a run in real time needs to be repeated.
struct RecordedTurns {
  std::vector<agents::Turn> turns;  ///< In their order.
  hal::Time ended_at{};
};

/// Reads them from `run.sqlite` in a folder.
/// @throws std::runtime_error if it is missing, damaged, of another version, not of a run in real
/// time, or of one that never ended.
RecordedTurns read_turns(const std::filesystem::path& folder);

}  // namespace sim::record
