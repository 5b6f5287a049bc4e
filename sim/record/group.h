#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/record/quantiles.h"
#include "sim/record/run_result.h"

namespace sim::record {

/// How one robot drove in one run.
struct Drive {
  std::string robot;
  double path = 0;      ///< m
  double straight = 0;  ///< m from its start to the goal, or to where it ended if there is none.
  std::optional<double> clearance;  ///< m, least distance of its centre to a wall's surface.
  std::optional<std::uint64_t> wall_steps, object_steps;
  double ratio() const { return straight > 0 ? path / straight : 0; }
};
std::vector<Drive> drives(const RunResult& run);

/// The runs of one scenario with one radio profile.
struct Group {
  std::string name;                    ///< The profile, with the scenario if there are several.
  std::vector<const RunResult*> runs;  ///< Complete ones.
  std::size_t left_out = 0;            ///< Runs that were broken off or failed.

  std::vector<double> discoveries() const;  ///< s, pooled.
  std::vector<double> delays() const;       ///< s, pooled.
  std::vector<Drive> all_drives() const;
  std::map<int, std::uint64_t> packets() const;  ///< By agent, summed.
};

/// In order of first appearance.
std::vector<Group> group_runs(const std::vector<RunResult>& runs);

/// Mean of |ln(ours / paper's)| over the quartiles of discovery and delay: 0 is equal. None if a
/// figure is missing.
std::optional<double> replica_score(const std::optional<Quantiles>& discovery,
                                    const std::optional<Quantiles>& delay);

}  // namespace sim::record
