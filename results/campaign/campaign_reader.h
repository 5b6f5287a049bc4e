#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "results/campaign/rows.h"
#include "results/record/database.h"

namespace results::campaign {

/// A campaign's database, open for reading. The campaign may still be running.
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

  /// Whether the folder holds a campaign: it has a database, and is not a folder of `baraka run
  /// --replications`, which has one beside its more detailed results.
  static bool is_campaign(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }

  /// @param sql  one SELECT; for tables and columns see schema.h. The result must not outlive this
  ///   object.
  record::Statement query(std::string_view sql) { return {database_, sql}; }

  /// Value of a key of the table `campaign`; "" if the key is not there.
  std::string value(std::string_view key);

  std::vector<Factor> factors();   ///< In the order of the campaign file.
  std::vector<PointRow> points();  ///< Sorted by number; levels in the order of the factors.
  std::vector<RunRow> runs();      ///< Sorted by number.

  /// Number of rows of each table.
  std::map<std::string, std::int64_t> count_rows();

 private:
  std::filesystem::path folder_;
  record::Database database_;
};

}  // namespace results::campaign
