#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/report/experiment.h"
#include "results/report/group.h"

namespace results::report {

/// What a report is made from.
struct Sources {
  std::vector<RunResult> runs;          ///< Of folders with results.
  std::vector<Experiment> experiments;  ///< Those runs as one, then each campaign.
};

/// @param folders  of results, or holding some, or of campaigns.
/// @throws std::runtime_error if one cannot be read.
Sources read_sources(const std::vector<std::filesystem::path>& folders);

/// The tables of one or many results in plain text: each run; the figures of the runs of the same
/// settings, beside the paper's if they ask for that and are of its case study; the settings in
/// which they differ; the links of the network, the packets of each node, the delays by hops; and
/// the experiment that they make up.
/// @param case_study  settings of the paper's case study; none: not known.
/// @throws std::runtime_error if a report is asked for that cannot be given.
std::string report(const Sources& sources, const std::optional<Settings>& case_study);

}  // namespace results::report
