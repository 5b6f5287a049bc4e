#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "baraka/campaign/time_left.h"
#include "results/campaign/rows.h"

namespace baraka::campaign {

/// "90 s", "12 min 05 s", "11 h 07 min".
std::string clock_like(double seconds);

/// "about 12 min left (10 min to 14 min)".
std::string words_of(const TimeLeft& left);

/// Shows on standard error the progress of a campaign and when it will be done: on a terminal by a
/// progress bar, otherwise by a line every ten seconds. Also prints a line for each run that ends,
/// or only for each that fails.
class CampaignProgress {
 public:
  using Clock = std::chrono::steady_clock;
  struct Settings {
    bool terminal = false;
    bool every_run = false;  ///< Print a line for each run that ends, not only for failed ones.
    std::size_t slots = 1;   ///< Number of parallel runs.
  };
  explicit CampaignProgress(Settings settings) : settings_(settings) {}

  /// Notes a run that had ended before; used only for the estimate.
  void on_earlier(const results::campaign::RunRow& row);
  /// Sets the runs to do, in the order in which they start. Runs already under way come first, and
  /// on_start() must be called for them, too.
  void set_waiting(const std::vector<results::campaign::RunPlan>& runs);
  /// Notes that a run was passed to the engine. If there are more than slots, the later ones wait.
  void on_start(const results::campaign::RunPlan& run, Clock::time_point now);
  /// @param name  of the run, for display.
  void on_end(const results::campaign::RunRow& row, const std::string& name, Clock::time_point now);

  /// @param running  number of runs passed to the engine that are actually running.
  void show(Clock::time_point now, std::size_t running);
  /// Ends the progress line.
  void end();

  std::optional<TimeLeft> left(Clock::time_point now) const;

 private:
  std::string summary(Clock::time_point now) const;
  std::string bar() const;
  void clear_line();
  void fill_slots(Clock::time_point now);

  Settings settings_;
  TimeLeftEstimate estimate_;
  std::vector<int> waiting_;  ///< Points of the waiting runs; that of the next run is last.
  std::map<std::int64_t, std::pair<int, Clock::time_point>> running_;  ///< Point and start, by run.
  std::map<std::int64_t, int> queued_;  ///< Point, by run, of runs that wait for a slot.
  std::size_t total_ = 0, ended_ = 0, failed_ = 0;
  Clock::time_point shown_{};
  bool line_open_ = false;
};

}  // namespace baraka::campaign
