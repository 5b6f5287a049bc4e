#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace baraka::campaign {

/// How long many runs will still take.
struct TimeLeft {
  double seconds = 0;               ///< Expected.
  std::optional<double> low, high;  ///< 95 % of such estimates are right about what comes between.
};

/// Estimates it from the wall times of the runs that have ended: by point, where one of a point has
/// ended, since points may differ in length; else by the mean of all.
class TimeLeftEstimate {
 public:
  /// A run of that point has ended after so long [s].
  void add(int point, double wall_s);

  /// A run under way, and since when [s].
  struct Running {
    int point = 0;
    double for_s = 0;
  };

  /// @param running  at most as many as there are slots.
  /// @param waiting  runs not started yet, by point, in the order in which they will be.
  /// @param slots  how many run at the same time, at least 1.
  /// @return none before the first run has ended. The limits are Student's t on the scatter within
  ///   points, as of independent runs: of the sum of those to come, and of the mean they are
  ///   predicted with.
  std::optional<TimeLeft> left(const std::vector<Running>& running, const std::vector<int>& waiting,
                               std::size_t slots) const;

  /// Mean over the runs of a point that have ended, else over all [s]. @pre one has ended.
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
