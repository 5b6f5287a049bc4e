#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "sim/campaign/campaign_reader.h"

namespace sim::report {

/// Writes one table of a result as CSV (Y. Shafranovich, RFC 4180, 2005): a line with the names of
/// the columns, then one per row, in the order of the primary key if the table has one, else as
/// written. A null is an empty field, an empty text is `""`.
/// @param write  gets the text piece by piece.
/// @throws std::runtime_error  the folder has no result of this version, or there is no such table.
void write_csv(const std::filesystem::path& folder, std::string_view table,
               const std::function<void(std::string_view)>& write);

/// The same of a table of a campaign. @throws std::runtime_error  there is no such table.
void write_csv(campaign::CampaignReader& reader, std::string_view table,
               const std::function<void(std::string_view)>& write);

}  // namespace sim::report
