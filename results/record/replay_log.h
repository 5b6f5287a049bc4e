#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/agents/real_time.h"
#include "sim/core/outside_input.h"

namespace results::record {

/// What is needed to repeat a run, besides its scenario and seed.
struct ReplayLog {
  bool in_real_time = false;
  std::vector<sim::agents::Turn> turns;       ///< In their order; none in lock-step.
  std::vector<sim::OutsideArrival> arrivals;  ///< Sorted by time.
  hal::Time ended_at{};
};

/// Reads it from `run.sqlite` in a folder.
/// @throws std::runtime_error  the file is missing, damaged or of another version; or the run needs
/// no log because scenario and seed repeat it (lock-step, nothing from outside); or the run never
/// ended.
ReplayLog read_replay_log(const std::filesystem::path& folder);

/// Reads the table settings. @throws std::runtime_error as read_replay_log().
std::map<std::string, std::string> read_settings(const std::filesystem::path& folder);

}  // namespace results::record
