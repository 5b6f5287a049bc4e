#pragma once

#include <optional>
#include <span>
#include <vector>

#include "results/statistics/interval.h"

namespace results::statistics {

/// The p-quantile of type 7: linear between order statistics, at position (n - 1) p counted from 0
/// (R. J. Hyndman and Y. Fan, "Sample Quantiles in Statistical Packages", The American Statistician
/// 50(4), 1996).
/// @param sorted  ascending, not empty. @param p  in [0, 1].
double quantile_of_sorted(std::span<const double> sorted, double p);

/// The same of values in any order; none if there are none.
std::optional<double> quantile(std::vector<double> values, double p);

/// A confidence interval of the p-quantile from two order statistics, whatever the distribution:
/// so many of n values lie below it as a binomial variable (n, p) says (W. J. Conover, "Practical
/// Nonparametric Statistics", 3rd ed., section 3.2). Each tail has at most (1 - level) / 2.
struct QuantileInterval {
  Interval interval;
  double coverage = 0;  ///< At least the level that was asked for.
};

/// None if there are too few values for an end of it: for the median at 95 %, fewer than six.
std::optional<QuantileInterval> quantile_interval(std::vector<double> values, double p,
                                                  double level = kLevel);

}  // namespace results::statistics
