#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "gateway/run/replications_folder.h"

namespace gateway {

/// Tells on standard error how far many runs are, and when they will be done: a line for each that
/// ends, and on a terminal one that is kept up to date.
class ReplicationProgress {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param total  to run now. @param jobs  at a time.
  ReplicationProgress(int total, int jobs, bool terminal)
      : total_(total), jobs_(jobs), terminal_(terminal) {}

  void on_start(const Replication& replication, Clock::time_point now);
  void on_end(const Replication& replication, const ReplicationEnd& end, Clock::time_point now);

  /// Shows the line of the terminal, twice a second.
  void show(Clock::time_point now);

  /// Leaves the line of the terminal.
  void end();

  /// Until all have ended, if those left take as long as those that have ended took on average;
  /// none before the first has ended.
  std::optional<double> seconds_left(Clock::time_point now) const;

 private:
  std::string summary(Clock::time_point now) const;

  int total_, jobs_;
  bool terminal_;
  int ended_ = 0;
  double took_ = 0;  ///< s, sum of those ended.
  std::map<int, Clock::time_point> running_;
  Clock::time_point shown_{};
  bool line_open_ = false;
};

}  // namespace gateway
