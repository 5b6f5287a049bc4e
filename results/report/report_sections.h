#pragma once

#include <string>
#include <vector>

#include "results/report/group.h"
#include "results/report/paper.h"
#include "results/report/run_result.h"

namespace results::report {

/// The tables that make up a report.

/// One line per run and robot.
std::string runs_section(const std::vector<RunResult>& runs);

/// What the runs of a group recorded: the head first.
struct RecordedTable {
  std::string title;
  std::string file;  ///< Table of the result that has all of it.
  std::vector<std::vector<std::string>> rows;
};
/// Values that controllers recorded, states that they named, observables; those that have rows.
std::vector<RecordedTable> recorded_tables(const Group& group);
/// The same as text, each table cut off after some rows; "" if nothing was recorded.
std::string recorded_section(const Group& group);

/// One line of the comparison: what it is, the paper's figure ("" if it has none) and what it is
/// worth, each group's, and how many times the paper's that is where it can be said.
struct ComparisonRow {
  std::string figure, paper;
  paper::Basis basis = paper::Basis::kNone;
  std::vector<std::string> ours;
  std::vector<std::optional<double>> times_paper;
};

/// Whether it is more than a factor of two off.
bool is_far_off(const std::optional<double>& times_paper);
std::vector<ComparisonRow> comparison_rows(const std::vector<Group>& groups);

/// One line per figure, a column for each group, and one for the paper if one of them is of its
/// case study; else why there is none.
std::string comparison_section(const std::vector<Group>& groups);

/// One line per setting that is not the same in all groups, a column for each.
std::string differences_section(const std::vector<Group>& groups);

/// Links between motes and how many each has, at the start: Fig. 2 of the paper.
std::string links_section(const Group& group);

/// Packets received by each node: Fig. 12.
std::string packets_section(const Group& group);

/// What became of each frame at each other radio, and the links that lost most: why frames were
/// lost. In sum, what was sent.
std::string losses_section(const Group& group);

/// What the air was used for: a table of the topics of programs, and one of all that was sent; ""
/// if no agent has a network.
std::string air_section(const Group& group);

/// What access points did with what they had to pass on, by destination; "" if there was nothing.
std::string relays_section(const Group& group);

/// Why samples of programs did not come, and where that was; "" if all came.
std::string sample_losses_section(const Group& group);

/// How often the routing protocols did what they do; "" if nothing was counted.
std::string routing_section(const Group& group);

/// Least end-to-end delay by number of transmissions, beside what the MAC allows.
std::string hops_section(const Group& group);

}  // namespace results::report
