#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "results/campaign/campaign_reader.h"

namespace baraka::campaign {

/// The progress of a campaign according to its database.
struct CampaignStatus {
  std::size_t points = 0, runs = 0, waiting = 0, running = 0, done = 0, failed = 0;
  std::size_t unmet = 0;                       ///< Done runs that did not meet an expectation.
  std::map<std::string, std::size_t> results;  ///< Number of done runs by result.
  std::string table;                           ///< Text with a line for each point.
  std::string bad_ends;  ///< A line for each run that failed or did not meet an expectation.
};

/// @param replications  runs with a higher replication number are ignored.
CampaignStatus status_of(results::campaign::CampaignReader& reader, int replications);

/// `baraka campaign FILE --status`: prints the progress of the campaign in a folder, which may be
/// running.
/// @return exit status. @throws std::runtime_error
int print_status(const std::filesystem::path& folder);

}  // namespace baraka::campaign
