#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "results/campaign/campaign_reader.h"

namespace results::report {

/// Writes one table of a result as CSV (Y. Shafranovich, RFC 4180, 2005): a line with the column
/// names, then one line per row, in the order of the primary key if the table has one, otherwise as
/// recorded. A null is an empty field, an empty text is `""`; texts are written by csv_text().
/// @param write  receives the text piece by piece.
/// @throws std::runtime_error  the folder has no result of this version, or there is no such table.
void write_csv(const std::filesystem::path& folder, std::string_view table,
               const std::function<void(std::string_view)>& write);

/// The same for a table of a campaign. @throws std::runtime_error  there is no such table.
void write_csv(campaign::CampaignReader& reader, std::string_view table,
               const std::function<void(std::string_view)>& write);

/// A text as a CSV field. Spreadsheets may execute a text that begins with = + - @, a tab or a line
/// end as a formula (OWASP, "CSV Injection"), so such a text gets a leading '. Texts that consist
/// only of numbers, "-" and units ("-85 dBm", "-0.5 - 0.31") do not.
std::string csv_text(std::string_view text);

}  // namespace results::report
