#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace baraka::campaign {

/// Estimate of the time until the remaining runs are done.
struct TimeLeft {
  double seconds = 0;               ///< Expected time.
  std::optional<double> low, high;  ///< 95 % prediction interval, s.
};

/// Estimates the time left from the wall times of ended runs. Because points may differ in length,
/// a run is predicted by the mean of its own point if a run of that point has ended, otherwise by
/// the mean of all.
class TimeLeftEstimate {
 public:
  /// Adds an ended run. @param wall_s  its wall time, s.
  void add(int point, double wall_s);

  /// A run under way; for_s: how long it has been running, s.
  struct Running {
    int point = 0;
    double for_s = 0;
  };

  /// @param running  at most `slots` runs.
  /// @param waiting  points of the runs not started yet, in the order in which they will start.
  /// @param slots  number of parallel runs, at least 1.
  /// @return none before the first run has ended. The limits use Student's t and the variance
  /// within
  ///   points, assuming independent runs: the variance of the sum of the remaining runs plus that
  ///   of the mean by which they are predicted, shared by the slots.
  std::optional<TimeLeft> left(const std::vector<Running>& running, const std::vector<int>& waiting,
                               std::size_t slots) const;

  /// Mean wall time of the ended runs of a point, or of all ended runs if that point has none, s.
  /// @pre At least one run has ended.
  double mean_of(int point) const;

 private:
  struct Sums {
    std::size_t count = 0;
    double mean = 0;     ///< s
    double squares = 0;  ///< s^2, sum of squared deviations from the mean (Welford, 1962).
  };
  static void add_to(Sums& sums, double value);

  std::map<int, Sums> points_;
  Sums all_;
};

}  // namespace baraka::campaign
