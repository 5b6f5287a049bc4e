#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "results/campaign/campaign_reader.h"

namespace results::report {

/// Writes one table of a result as CSV (Y. Shafranovich, RFC 4180, 2005): a line with the names of
/// the columns, then one per row, in the order of the primary key if the table has one, else as
/// written. A null is an empty field, an empty text is `""`; a text is as csv_text() has it.
/// @param write  gets the text piece by piece.
/// @throws std::runtime_error  the folder has no result of this version, or there is no such table.
void write_csv(const std::filesystem::path& folder, std::string_view table,
               const std::function<void(std::string_view)>& write);

/// The same of a table of a campaign. @throws std::runtime_error  there is no such table.
void write_csv(campaign::CampaignReader& reader, std::string_view table,
               const std::function<void(std::string_view)>& write);

/// A text as a field. Spreadsheets take a text for a formula, and may run what it says, that begins
/// with = + - @, a tab or a line end (OWASP, "CSV Injection"): before such a text stands a ', which
/// keeps it a text. Not where words of a number, of "-" and of units follow one another: "-85 dBm",
/// "-0.5 - 0.31".
std::string csv_text(std::string_view text);

}  // namespace results::report
