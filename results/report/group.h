#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/report/quantiles.h"
#include "results/report/run_result.h"

namespace results::report {

/// A robot without a goal counts as returned to its start if the straight line from start to end is
/// shorter than this share of its path.
inline constexpr double kLeastStraight = 0.1;

/// How one robot drove in one run.
struct RobotDrive {
  std::string robot;
  double path = 0;      ///< m
  double straight = 0;  ///< m, from its start to the goal; without a goal, to its last place.
  bool has_goal = false;
  std::optional<double> clearance;  ///< m, smallest distance of its centre from a wall's surface.
  std::optional<std::uint64_t> wall_steps, object_steps;
  /// path / straight. None if the straight line is at most a micrometre long or, without a goal, at
  /// most kLeastStraight of the path: the robot came back, and the ratio would mean nothing.
  std::optional<double> ratio() const;
};
std::vector<RobotDrive> drives(const RunResult& run);

/// Keys and values of the table `settings`.
using Settings = std::map<std::string, std::string>;

/// Numbers of frames at radios: unicast frames at their addressee, broadcast frames, and unicast
/// frames at other radios.
struct FrameSums {
  std::uint64_t to_it = 0, to_everyone = 0, to_others = 0;
  std::uint64_t all() const { return to_it + to_everyone + to_others; }
};

/// What became at agent `to` of the frames that agent `from` sent to it or to everyone.
struct LinkSums {
  int from = 0, to = 0;
  std::map<std::string, std::uint64_t> verdicts;
  std::uint64_t sent() const;
  std::uint64_t delivered() const;
};

inline constexpr std::size_t kLongestName = 40;  ///< Bytes of a group's name.

/// The runs of one scenario that differ only in their seeds.
struct Group {
  /// The scenario's name. For the paper's case study, and for a scenario that was run with several
  /// radio profiles, the profile (after the scenario's name if there are several scenarios). Groups
  /// that would have the same name get the setting in which they differ appended, or the folder of
  /// the result if they differ in several. With several groups, at most kLongestName bytes.
  std::string name;
  std::string full_name{};  ///< The name before it was shortened; "": it was not shortened.
  std::string folder;       ///< Folder of the first run.
  /// Settings of each run, with the version; without the seed, `report` and `compare`.
  Settings settings;
  std::vector<const RunResult*> runs;  ///< Complete runs.
  std::size_t left_out = 0;      ///< Runs that were interrupted, failed, not started or copies.
  bool asks_for_papers = false;  ///< Its scenario has `compare: labella2009`.
  /// Why a requested comparison with the paper's figures is not made; empty: there is no reason.
  std::string not_the_papers;
  bool is_the_papers() const { return asks_for_papers && not_the_papers.empty(); }

  std::vector<double> discoveries() const;  ///< Times of all runs [s].
  std::vector<double> delays() const;       ///< Delays in all runs [s].
  std::vector<RobotDrive> all_drives() const;
  std::map<int, std::uint64_t> packets() const;  ///< By agent, sum over the runs.
  /// By verdict, sum over the runs.
  std::map<std::string, FrameSums> frame_verdicts() const;
  std::vector<LinkSums> link_verdicts() const;  ///< By link, sum over the runs.
};

/// Groups in order of first appearance.
/// @param case_study  settings of the paper's case study; none: not known.
std::vector<Group> group_runs(const std::vector<RunResult>& runs,
                              const std::optional<Settings>& case_study);

/// A setting that differs between groups, and its value in each group; "-": not set there.
struct Difference {
  std::string key;
  std::vector<std::string> values;
};
std::vector<Difference> differences(const std::vector<Group>& groups);

/// Whether any group is compared with the paper's case study.
bool has_the_papers(const std::vector<Group>& groups);

/// Mean of |ln(ours / paper's)| over the six quartiles of discovery and delay; 0: equal. None if a
/// figure is missing.
std::optional<double> replica_score(const std::optional<Quantiles>& discovery,
                                    const std::optional<Quantiles>& delay);

}  // namespace results::report
