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

/// A table of values that the runs of a group recorded.
struct RecordedTable {
  std::string title;
  std::string file;                            ///< Table of the result with the complete data.
  std::vector<std::vector<std::string>> rows;  ///< The head, then the rows.
};
/// Tables of values that controllers recorded, of their states, and of observables; without empty
/// ones.
std::vector<RecordedTable> recorded_tables(const Group& group);
/// The same as text; long tables are cut off. "" if nothing was recorded.
std::string recorded_section(const Group& group);

/// One line of the comparison: name of the figure, the paper's value ("": none) and its basis, the
/// value of each group, and the ratio of that to the paper's value where it is defined.
struct ComparisonRow {
  std::string figure, paper;
  paper::Basis basis = paper::Basis::kNone;
  std::vector<std::string> ours;
  std::vector<std::optional<double>> times_paper;
};

/// Whether a ratio is above 2 or below 0.5.
bool is_far_off(const std::optional<double>& times_paper);
std::vector<ComparisonRow> comparison_rows(const std::vector<Group>& groups);

/// One line per figure with a column for each group. If a group belongs to the paper's case study
/// there is a column for the paper; otherwise the text says why there is none.
std::string comparison_section(const std::vector<Group>& groups);

/// One line per setting that differs between groups, with a column for each group.
std::string differences_section(const std::vector<Group>& groups);

/// Links between motes at the start, and the number of neighbours of each: Fig. 2 of the paper.
std::string links_section(const Group& group);

/// Packets received by each node: Fig. 12 of the paper.
std::string packets_section(const Group& group);

/// Verdicts of all frames at all other radios, and the links that lost most. The verdicts sum to
/// frames sent times radios.
std::string losses_section(const Group& group);

/// Use of the air: a table of the DDS topics of programs and one of all frames by kind; "" if no
/// agent has a network.
std::string air_section(const Group& group);

/// Frames that access points relayed or could not relay, by destination; "" if there were none.
std::string relays_section(const Group& group);

/// Queues for receivers and access categories, and what they dropped; "" if there were none.
std::string queues_section(const Group& group);

/// Why and where samples of programs were lost; "" if all arrived.
std::string sample_losses_section(const Group& group);

/// Numbers of events of the routing protocols; "" if none was counted.
std::string routing_section(const Group& group);

/// Shortest end-to-end delay by number of transmissions, beside the shortest that the MAC allows.
std::string hops_section(const Group& group);

}  // namespace results::report
