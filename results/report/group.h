#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/report/quantiles.h"
#include "results/report/run_result.h"

namespace results::report {

/// Of a robot's path without a goal: below this share the robot came back to where it started.
inline constexpr double kLeastStraight = 0.1;

/// How one robot drove in one run.
struct RobotDrive {
  std::string robot;
  double path = 0;      ///< m
  double straight = 0;  ///< m from its start to the goal, or to where it ended if there is none.
  bool has_goal = false;
  std::optional<double> clearance;  ///< m, least distance of its centre to a wall's surface.
  std::optional<std::uint64_t> wall_steps, object_steps;
  /// Of path to straight. None: the goal is where it started, to a micrometre; or without a goal,
  /// it came back, so that the straight line says nothing of its way: shorter than
  /// kLeastStraight of the path.
  std::optional<double> ratio() const;
};
std::vector<RobotDrive> drives(const RunResult& run);

/// Keys of the table settings and their values.
using Settings = std::map<std::string, std::string>;

/// Frames at radios that they were for: one alone, or everyone; and at others.
struct FrameSums {
  std::uint64_t to_it = 0, to_everyone = 0, to_others = 0;
  std::uint64_t all() const { return to_it + to_everyone + to_others; }
};

/// Frames that one agent sent to another, or to everyone, there.
struct LinkSums {
  int from = 0, to = 0;
  std::map<std::string, std::uint64_t> verdicts;
  std::uint64_t sent() const;
  std::uint64_t delivered() const;
};

inline constexpr std::size_t kLongestName = 40;  ///< Letters of a group's name.

/// The runs of one scenario with the same settings but for the seed.
struct Group {
  /// The scenario; of the paper's case study, or where a scenario has several, the profile of the
  /// radio. Where that is the same for several groups, with the setting in which they differ, or
  /// with the folder of the result if they differ in more. At most kLongestName letters.
  std::string name;
  std::string full_name{};  ///< What a shortened name stands for; "": it is not shortened.
  std::string folder;       ///< Of the first run.
  Settings settings;  ///< Of each run, with the version; without the seed, `report`, `compare`.
  std::vector<const RunResult*> runs;  ///< Complete ones.
  std::size_t left_out = 0;            ///< Broken off, failed, not started, or copies.
  bool asks_for_papers = false;        ///< Its scenario has `compare: labella2009`.
  /// Why the paper's figures are not to be compared with these though it asks; empty: they are.
  std::string not_the_papers;
  bool is_the_papers() const { return asks_for_papers && not_the_papers.empty(); }

  std::vector<double> discoveries() const;  ///< s, pooled.
  std::vector<double> delays() const;       ///< s, pooled.
  std::vector<RobotDrive> all_drives() const;
  std::map<int, std::uint64_t> packets() const;  ///< By agent, summed.
  /// Of the frames to somebody else, to one radio alone, and to everyone: by verdict, summed.
  std::map<std::string, FrameSums> frame_verdicts() const;
  std::vector<LinkSums> link_verdicts() const;  ///< By link, summed.
};

/// In order of first appearance.
/// @param case_study  settings of the paper's case study; none: not known.
std::vector<Group> group_runs(const std::vector<RunResult>& runs,
                              const std::optional<Settings>& case_study);

/// A setting that is not the same in all groups, and what it is in each; "-": not set there.
struct Difference {
  std::string key;
  std::vector<std::string> values;
};
std::vector<Difference> differences(const std::vector<Group>& groups);

/// Whether any of them is of the paper's case study.
bool has_the_papers(const std::vector<Group>& groups);

/// Mean of |ln(ours / paper's)| over the quartiles of discovery and delay: 0 is equal. None if a
/// figure is missing.
std::optional<double> replica_score(const std::optional<Quantiles>& discovery,
                                    const std::optional<Quantiles>& delay);

}  // namespace results::report
