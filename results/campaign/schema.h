#pragma once

#include <string_view>
#include <vector>

#include "results/record/schema.h"

namespace results::campaign {

/// Version of the tables below, stored as `PRAGMA user_version` of the file. Any change of a table,
/// of a column or of its meaning needs a new version; readers accept only this one.
inline constexpr int kSchemaVersion = 2;

/// Name of the database file in the folder of a campaign.
inline constexpr const char* kCampaignDatabase = "campaign.sqlite";

/// File beside the database that only folders of `baraka run --replications` have: the request.
inline constexpr const char* kReplicationsFile = "replications.yaml";

/// The tables of `campaign.sqlite` and the keys of its table `campaign`. The file, its description
/// and the list of exportable tables all derive from these.
const std::vector<record::Table>& tables();
const std::vector<record::RunKey>& campaign_keys();

/// The SQL statements that create the tables and their indices.
std::string schema_sql();

}  // namespace results::campaign
