#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "results/campaign/campaign_file.h"
#include "results/campaign/factors.h"

namespace baraka::campaign {

/// A campaign file all of whose points have been checked.
struct CheckedCampaign {
  results::campaign::CampaignFile file;
  std::uint64_t seed = 0;                ///< Of replication 1.
  results::campaign::FactorTable table;  ///< Its points have their scenarios, resolved.
  std::set<std::string> controllers;     ///< Of all points.
  std::vector<std::string> warnings;     ///< Of the points' scenarios, each once.
};

/// Reads a campaign file and the scenario of each of its points.
/// @param overrides  of the campaign file, "key=value".
/// @throws hal::files::config::ConfigErrors  with every mistake of all points: one of a value that
/// is varied
///   stands at that value in the campaign file, with the point that shows it; one of the scenario
///   that no point is without, once.
CheckedCampaign check_campaign(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace baraka::campaign
