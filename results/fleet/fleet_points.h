#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/campaign/campaign_file.h"
#include "results/fleet/fleet_file.h"

namespace results::fleet {

/// One case of a fleet: indices into the lists of its file.
struct Case {
  std::size_t radio = 0, site = 0, profile = 0;
  int robots = 0;
};

/// The names of a case's radio, site and profile; one that is the only one has none. An index
/// beyond the list leaves its part out.
std::string words_of(const FleetFile& fleet, const Case& one);

/// The campaign that a fleet file asks for: one point for each case, in this order.
struct FleetPlan {
  campaign::CampaignFile campaign;
  std::vector<Case> cases;
};

/// The scenario of a fleet, as far as its points depend on it.
struct FleetScenario {
  std::string layout;               ///< "circle", "line" or "uniform": how the group is placed.
  std::vector<std::string> on_air;  ///< Groups of agents with a `network`.
};

/// @param file  of the scenario.
/// @throws hal::files::config::ConfigErrors  it has no such group, or the group is placed one by
/// one.
FleetScenario fleet_scenario(const std::filesystem::path& file, const FleetFile& fleet);

FleetPlan plan_of(const FleetFile& fleet, const FleetScenario& scenario);

}  // namespace results::fleet
