#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "results/campaign/rows.h"
#include "results/record/database.h"

namespace results::campaign {

/// A campaign's database, open for reading; also while the campaign runs.
///
///   CampaignReader reader(folder);
///   for (const RunRow& run : reader.runs()) …
///   Statement values = reader.query("SELECT run, value FROM measurements WHERE observable = 3");
///
/// Every member throws std::runtime_error if the file is damaged. One thread.
class CampaignReader {
 public:
  /// @param folder  holds `campaign.sqlite`.
  /// @throws std::runtime_error  it is missing, damaged or of another version.
  explicit CampaignReader(const std::filesystem::path& folder);

  /// Whether the folder has such a file.
  static bool has_database(const std::filesystem::path& folder);

  /// Whether it is the folder of a campaign: it has such a file, and not only beside the results of
  /// `baraka run --replications`, which say more.
  static bool is_campaign(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }

  /// @param sql  one SELECT (tables and columns of schema.h); must not outlive this object.
  record::Statement query(std::string_view sql) { return {database_, sql}; }

  /// Of the table campaign; "" if the key is not there.
  std::string value(std::string_view key);

  std::vector<Factor> factors();   ///< In their order.
  std::vector<PointRow> points();  ///< By number, levels in the order of the factors.
  std::vector<RunRow> runs();      ///< By number.

  /// How many rows each table has.
  std::map<std::string, std::int64_t> count_rows();

 private:
  std::filesystem::path folder_;
  record::Database database_;
};

}  // namespace results::campaign
