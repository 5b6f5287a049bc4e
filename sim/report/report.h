#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/report/group.h"

namespace sim::report {

/// The tables of one or many results in plain text: each run; the figures of the runs of the same
/// settings, beside the paper's if they are of its case study; the settings in which they differ;
/// the links of the network, the packets of each node, the delays by hops.
/// @param folders  of results, or holding some.
/// @param case_study  settings of the paper's case study; none: not known.
/// @throws std::runtime_error if one cannot be read.
std::string report(const std::vector<std::filesystem::path>& folders,
                   const std::optional<Settings>& case_study);

}  // namespace sim::report
