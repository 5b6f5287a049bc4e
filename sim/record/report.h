#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sim::record {

/// The tables of one or many results in plain text: each run; the figures of each radio profile
/// beside the paper's; the links of the network, the packets of each node, the delays by hops.
/// @param folders  of results, or holding some.
/// @throws std::runtime_error if one cannot be read.
std::string report(const std::vector<std::filesystem::path>& folders);

}  // namespace sim::record
