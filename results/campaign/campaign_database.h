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

/// A campaign's database, open for writing; created if it does not exist. Every call is one
/// transaction that is on the disk when the call returns: if the process or the machine dies, the
/// file holds each run completely or not at all. One writer at a time (the campaign's folder is
/// locked), one thread.
///
/// Every member throws std::runtime_error with SQLite's reason if it cannot write, for example on a
/// full disk; the file is then unchanged by the call.
class CampaignDatabase {
 public:
  /// @param folder  of the campaign; must exist.
  /// @param while_busy  see record::Database. Other processes may read the file at any time, and
  ///   while one does, nothing can be written.
  /// @throws std::runtime_error  the file is damaged or of another version.
  explicit CampaignDatabase(const std::filesystem::path& folder,
                            record::Database::WhileBusy while_busy = {});

  /// Whether it holds no plan yet.
  bool is_empty();

  /// Value of a key of the table `campaign`; "" if the key is not there.
  std::string value(std::string_view key);
  void set(std::string_view key, std::string_view value);

  /// Rows that add() writes in one transaction.
  struct Plan {
    std::vector<std::pair<std::string, std::string>> values;  ///< Of the table `campaign`.
    std::vector<Factor> factors;
    std::vector<PointRow> points;  ///< New points.
    std::vector<RunPlan> runs;     ///< New runs; their state becomes "waiting".
    /// Existing points, identified by number, whose scenarios are replaced.
    std::vector<PointRow> rewritten{};
  };
  void add(const Plan& plan);

  /// Marks runs as running and counts an attempt of each. @param started  UTC.
  void start(std::span<const std::int64_t> runs, const std::string& started);

  /// Makes runs wait again. Everything recorded about them is deleted except the number of attempts
  /// and the time of the last start.
  void reset(std::span<const std::int64_t> runs);

  /// Records a run that has ended, identified by its number, and its measurements. The number of
  /// attempts is not changed.
  void finish(const RunRow& row, const Measured& measured);

 private:
  void transact(const std::function<void()>& changes);
  std::int64_t number_of(const MeasuredBy& observable);
  void add_measured(std::int64_t run, const Measured& measured);
  void forget(std::int64_t run);

  record::Database database_;
  /// Number of each observable, by name and agent.
  std::map<std::pair<std::string, std::string>, std::int64_t> observables_;
};

}  // namespace results::campaign
