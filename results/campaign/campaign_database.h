#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/campaign/rows.h"
#include "results/record/database.h"

namespace results::campaign {

/// A campaign's database, open for writing: made if it is not there. Every call is one transaction
/// that is on the disk when it returns: whenever the process dies, or the machine, a run is in it
/// as a whole or not at all. One writer at a time (the campaign's folder is locked), one thread.
///
/// Every member throws std::runtime_error, with SQLite's reason, if it cannot write (a full disk);
/// then nothing of the call is in the file.
class CampaignDatabase {
 public:
  /// @param folder  exists. @param while_busy  of record::Database: others may read the file at any
  ///   time, and as long as one does nothing can be written.
  /// @throws std::runtime_error  the file is damaged or of another version.
  explicit CampaignDatabase(const std::filesystem::path& folder,
                            record::Database::WhileBusy while_busy = {});

  /// Whether nothing has been planned in it.
  bool is_empty();

  /// Of the table campaign; "" if the key is not there.
  std::string value(std::string_view key);
  void set(std::string_view key, std::string_view value);

  /// What is added to it in one transaction.
  struct Plan {
    std::vector<std::pair<std::string, std::string>> values;  ///< Of the table campaign.
    std::vector<Factor> factors;
    std::vector<PointRow> points;  ///< Those not there yet.
    std::vector<RunPlan> runs;     ///< Those not there yet; they wait.
    /// There already, by their numbers: their scenarios are replaced.
    std::vector<PointRow> rewritten{};
  };
  void add(const Plan& plan);

  /// The runs were started. @param started  UTC.
  void start(std::span<const std::int64_t> runs, const std::string& started);

  /// They wait again: what was said of them is forgotten, but not how often they were started.
  void reset(std::span<const std::int64_t> runs);

  /// A run has ended: its row, by its number, and what it measured; attempts are not changed.
  void finish(const RunRow& row, const Measured& measured);

 private:
  void transact(const std::function<void()>& changes);
  std::int64_t number_of(const MeasuredBy& observable);
  void add_measured(std::int64_t run, const Measured& measured);
  void forget(std::int64_t run);

  record::Database database_;
  std::map<std::pair<std::string, std::string>, std::int64_t> observables_;  ///< Name and agent.
};

}  // namespace results::campaign
