#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "results/campaign/campaign_file.h"
#include "results/campaign/factors.h"

namespace baraka::campaign {

/// A campaign file with the results of checking all of its points.
struct CheckedCampaign {
  results::campaign::CampaignFile file;
  std::uint64_t seed = 0;                 ///< Seed of replication 1.
  results::campaign::FactorTable table;   ///< The points, with their resolved scenarios.
  std::set<std::string> controllers;      ///< Controllers of all points.
  std::set<std::filesystem::path> files;  ///< Other files on which the points' runs depend.
  std::vector<std::string> warnings;      ///< Warnings about the points' scenarios, each once.
};

/// Reads a campaign file and checks the scenario of each of its points.
/// @param overrides  "key=value" for keys of the campaign file.
/// @throws hal::files::config::ConfigErrors  with every mistake of all points. A mistake in a
/// varied
///   value is reported at that value in the campaign file, with the first point that has it; a
///   mistake that all points share is reported once, at its place in the scenario.
CheckedCampaign check_campaign(const std::string& path, const std::vector<std::string>& overrides);

/// The same for a campaign that was made from another file, beside which its scenario may be.
CheckedCampaign check_points(results::campaign::CampaignFile campaign,
                             const std::filesystem::path& file);

/// The scenario's file: beside `file`, otherwise in the folders of scenarios.
/// @throws hal::files::config::ConfigErrors  there is none.
std::filesystem::path scenario_file(const results::campaign::CampaignFile& campaign,
                                    const std::filesystem::path& file);

}  // namespace baraka::campaign
