#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/fleet/fleet_file.h"
#include "results/fleet/sample_measure.h"

namespace results::fleet {

/// Use of the air by one kind of traffic.
struct AirUse {
  std::string what;  ///< A topic group, "discovery", "acknowledgements", …
  double share = 0;  ///< Of the simulated time.
};

/// What a fleet's page needs of one run.
struct FleetRun {
  std::vector<SampleMeasure> needs;             ///< For each need of the file.
  std::map<std::string, SampleMeasure> topics;  ///< By topic group: "rt/*/scan".
  std::map<std::string, double> air;            ///< See AirUse.
  /// Share of the window in which the radio that is least idle transmits or finds the medium busy.
  std::optional<double> busy{};  ///< nullopt: the window has no whole second.
  std::string busiest;           ///< That radio's agent.
  /// Share of the window in which the radio that most often has frames to send has some.
  std::optional<double> backlogged{};
  std::string most_backlogged;     ///< That radio's agent.
  std::uint64_t handovers = 0;     ///< Changes from one access point to another.
  std::uint64_t unassociated = 0;  ///< Stations that never had an access point.
  double simulated_s = 0;
  double wall_s = 0;  ///< 0: not known.
};

/// The topic with `*` in place of the names of agents that are parts of it, between '/': what all
/// robots send is one group.
std::string group_of(const std::string& topic, const std::vector<std::string>& agents);

/// Reads a run with record: {samples: all}.
/// @throws std::runtime_error  the result is missing or damaged.
FleetRun read_fleet_run(const std::filesystem::path& folder, const FleetFile& fleet);

}  // namespace results::fleet
