#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/report/experiment.h"
#include "results/report/group.h"

namespace results::report {

/// The runs and experiments of a report.
struct Sources {
  std::vector<RunResult> runs;          ///< From folders with results.
  std::vector<Experiment> experiments;  ///< Those runs as one experiment, then each campaign.
};

/// @param folders  of results, of several results, or of campaigns.
/// @throws std::runtime_error if one cannot be read.
Sources read_sources(const std::vector<std::filesystem::path>& folders);

/// The report in plain text: each run; the figures of runs with the same settings, beside those of
/// the paper if the runs belong to its case study and ask for them; the settings in which groups
/// differ; the links of the network, the packets of each node, the delays by hops; and the
/// experiment that the runs form.
/// @param case_study  settings of the paper's case study; none: not known.
/// @throws std::runtime_error if a requested plot cannot be made.
std::string report(const Sources& sources, const std::optional<Settings>& case_study);

}  // namespace results::report
