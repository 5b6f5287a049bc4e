#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "results/campaign/campaign_reader.h"

namespace baraka::campaign {

/// How far a campaign is, by its database.
struct CampaignStatus {
  std::size_t points = 0, runs = 0, waiting = 0, running = 0, done = 0, failed = 0;
  std::size_t unmet = 0;                       ///< Of those done: an expectation did not hold.
  std::map<std::string, std::size_t> results;  ///< Of those done, by what they are called.
  std::string table;                           ///< A line for each point, for people.
  std::string bad_ends;  ///< A line for each run that failed or did not meet an expectation.
};

/// @param replications  those above do not count.
CampaignStatus status_of(results::campaign::CampaignReader& reader, int replications);

/// `baraka campaign FILE --status`: prints how far the campaign in a folder is, also while it runs.
/// @return exit status. @throws std::runtime_error
int print_status(const std::filesystem::path& folder);

}  // namespace baraka::campaign
