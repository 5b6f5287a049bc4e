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

/// Tells on standard error how far a campaign is, and when it will be done: on a terminal by a bar
/// that is kept up to date, else by a line every ten seconds; and a line for each run that ends, or
/// only for those that fail.
class CampaignProgress {
 public:
  using Clock = std::chrono::steady_clock;
  struct Settings {
    bool terminal = false;
    bool every_run = false;  ///< A line for each run that ends.
    std::size_t slots = 1;   ///< Runs at a time.
  };
  explicit CampaignProgress(Settings settings) : settings_(settings) {}

  /// A run that had ended before: for the estimate only.
  void on_earlier(const results::campaign::RunRow& row);
  /// All that is to be run from now on, in the order in which it is started; what is under way
  /// already, too, first: on_start() is told of it as of the others.
  void set_waiting(const std::vector<results::campaign::RunPlan>& runs);
  /// Given to what runs it. More than there are slots wait there, in the order given.
  void on_start(const results::campaign::RunPlan& run, Clock::time_point now);
  /// @param name  of the run, for people.
  void on_end(const results::campaign::RunRow& row, const std::string& name, Clock::time_point now);

  /// @param running  of those given to what runs them, how many are under way.
  void show(Clock::time_point now, std::size_t running);
  /// Leaves the line of the terminal.
  void end();

  std::optional<TimeLeft> left(Clock::time_point now) const;

 private:
  std::string summary(Clock::time_point now) const;
  std::string bar() const;
  void clear_line();
  void fill_slots(Clock::time_point now);

  Settings settings_;
  TimeLeftEstimate estimate_;
  std::vector<int> waiting_;  ///< Points, the next run's last.
  std::map<std::int64_t, std::pair<int, Clock::time_point>> running_;  ///< Point and start, by run.
  std::map<std::int64_t, int> queued_;  ///< Point, by run: for which there is no slot yet.
  std::size_t total_ = 0, ended_ = 0, failed_ = 0;
  Clock::time_point shown_{};
  bool line_open_ = false;
};

}  // namespace baraka::campaign
