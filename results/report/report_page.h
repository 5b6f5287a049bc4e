#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/report/group.h"
#include "results/report/report.h"

namespace results::report {

/// The data of the report page as JSON: the comparison, with the paper's figures (null if no group
/// belongs to its case study); the settings in which groups differ; nodes, links, walls, robots'
/// tracks, packets, discovery times and delays of each group; and the plots of each experiment as
/// drawings with their data.
/// Times are in seconds, or in nanoseconds where a key ends in _ns; lengths are in metres.
std::string report_json(const std::vector<Group>& groups,
                        const std::vector<Experiment>& experiments = {});

/// The report as one self-contained HTML page.
/// @param case_study  settings of the paper's case study; none: not known.
/// @param page  the page without figures, as built from results/report/page.
/// @throws std::runtime_error if a requested plot cannot be drawn, or `page` has no placeholder for
///   the figures.
std::string report_page(const Sources& sources, const std::optional<Settings>& case_study,
                        std::string page);

}  // namespace results::report
