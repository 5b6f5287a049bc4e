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

/// All runs that are asked for.
struct WantedRuns {
  std::vector<std::pair<std::string, std::string>> values;  ///< Of the table campaign.
  std::vector<Factor> factors;
  std::vector<PointRow> points;  ///< With their scenarios.
  int replications = 1;
  Seeds seeds = Seeds::kCommon;
  std::uint64_t base_seed = 0;
  /// Of a scenario's text what runs depend on, for the comparison with what is there.
  std::function<std::string(const std::string&)> essence = [](const std::string& text) {
    return text;
  };
  bool may_be_fewer = false;  ///< Fewer replications than there are leave the others as they are.
};

/// What a campaign's database needs to hold all of them.
struct Extension {
  CampaignDatabase::Plan plan;
  std::string said;  ///< For people: "3 more points, 30 more runs"; "" if nothing was there before.
};

/// @param reader  of the database as it is; it may be empty.
/// @throws hal::files::config::ConfigErrors  runs of other settings are there, or some that are not
/// asked
///   for any more; the message starts with the folder.
Extension extension(const WantedRuns& wanted, CampaignReader& reader);

/// The first lines in which two texts differ, for a message: "there 'a', now 'b'".
std::string first_difference(const std::string& old_text, const std::string& new_text);

}  // namespace results::campaign
