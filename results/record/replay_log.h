#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/agents/real_time.h"
#include "sim/core/outside_input.h"

namespace results::record {

/// What a run needs to be repeated, beside its scenario and seed.
struct ReplayLog {
  bool in_real_time = false;
  std::vector<sim::agents::Turn> turns;       ///< In their order; none in lock-step.
  std::vector<sim::OutsideArrival> arrivals;  ///< By time.
  hal::Time ended_at{};
};

/// Reads it from `run.sqlite` in a folder.
/// @throws std::runtime_error if it is missing, damaged, of another version, of a run that scenario
/// and seed repeat by themselves (in lock-step and with nothing from outside), or of one that never
/// ended.
ReplayLog read_replay_log(const std::filesystem::path& folder);

/// The table settings. @throws std::runtime_error as above.
std::map<std::string, std::string> read_settings(const std::filesystem::path& folder);

}  // namespace results::record
