#pragma once

#include <string>
#include <vector>

#include "baraka/campaign/campaign_options.h"

namespace baraka::fleet {

/// `baraka fleet`: carries out the remaining runs of a fleet file as a campaign, writes the page
/// `fleet.html` into its folder and prints the same tables on standard output.
/// @return exit status, as of a campaign.
/// @throws hal::files::config::ConfigErrors, UsageError, std::runtime_error
int run_fleet(const campaign::CampaignOptions& options);

/// Finds every mistake of a fleet file and of the scenarios of its cases.
/// @return warnings. @throws hal::files::config::ConfigErrors
std::vector<std::string> check_fleet(const std::string& path,
                                     const std::vector<std::string>& overrides);

}  // namespace baraka::fleet
