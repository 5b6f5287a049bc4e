#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "results/campaign/campaign_database.h"
#include "results/campaign/campaign_file.h"
#include "results/campaign/campaign_reader.h"

namespace results::campaign {

/// All runs that a campaign file asks for.
struct WantedRuns {
  std::vector<std::pair<std::string, std::string>> values;  ///< Of the table `campaign`.
  std::vector<Factor> factors;
  std::vector<PointRow> points;  ///< With their scenarios.
  int replications = 1;
  Seeds seeds = Seeds::kCommon;
  std::uint64_t base_seed = 0;
  /// Reduces a scenario's text to the part on which runs depend, to compare it with the scenario in
  /// the database.
  std::function<std::string(const std::string&)> essence = [](const std::string& text) {
    return text;
  };
  /// Fewer replications than the database holds are no error: the others stay.
  bool may_be_fewer = false;
};

/// The rows that a campaign's database lacks to hold all wanted runs.
struct Extension {
  CampaignDatabase::Plan plan;
  /// For display: "3 more points, 30 more runs"; "" if nothing is added or the database is new.
  std::string said;
};

/// @param reader  of the database; the database may be empty.
/// @throws hal::files::config::ConfigErrors  the database holds runs of other settings, or runs
/// that
///   are no longer wanted; the message starts with the folder.
Extension extension(const WantedRuns& wanted, CampaignReader& reader);

/// The first line in which two texts differ, for a message: "there 'a', now 'b'".
std::string first_difference(const std::string& old_text, const std::string& new_text);

}  // namespace results::campaign
