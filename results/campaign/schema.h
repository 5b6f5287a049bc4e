#pragma once

#include <string_view>
#include <vector>

#include "results/record/schema.h"

namespace results::campaign {

/// Version of the tables below, as `PRAGMA user_version` of the file. Any change of a table, of a
/// column or of what one means is a new version; readers accept this one only.
inline constexpr int kSchemaVersion = 2;

/// The file with the tables, in the folder of a campaign.
inline constexpr const char* kCampaignDatabase = "campaign.sqlite";

/// What a folder of `baraka run --replications` has beside it: what was asked for.
inline constexpr const char* kReplicationsFile = "replications.yaml";

/// The tables of `campaign.sqlite`, and the keys of its table `campaign`: the one source of the
/// file, of its description and of what may be exported.
const std::vector<record::Table>& tables();
const std::vector<record::RunKey>& campaign_keys();

/// As SQL, with the indices that are not for people.
std::string schema_sql();

}  // namespace results::campaign
