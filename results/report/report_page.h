#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/report/group.h"
#include "results/report/report.h"

namespace results::report {

/// What the figures of the report page are drawn from, as JSON: the comparison, with the paper's
/// figures (null if no group is of its case study), settings in which the groups differ and, for
/// each group, nodes, links, walls, robots' tracks, packets, times of discovery and delay.
/// Of each experiment its plots, drawn, with the data behind them.
/// Times are seconds, or nanoseconds where a key ends in _ns; lengths are metres.
std::string report_json(const std::vector<Group>& groups,
                        const std::vector<Experiment>& experiments = {});

/// The report as one page that needs nothing else.
/// @param case_study  settings of the paper's case study; none: not known.
/// @param page  the page without figures, as built from results/record/page.
/// @throws std::runtime_error if a plot is asked for that cannot be drawn, or the page has no place
///   for the figures.
std::string report_page(const Sources& sources, const std::optional<Settings>& case_study,
                        std::string page);

}  // namespace results::report
