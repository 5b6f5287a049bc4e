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

/// The same for values in any order; none if there are no values.
std::optional<double> quantile(std::vector<double> values, double p);

/// A distribution-free confidence interval of the p-quantile between two order statistics: the
/// number of the n values below the quantile is binomial (n, p) (W. J. Conover, "Practical
/// Nonparametric Statistics", 3rd ed., section 3.2). Each tail has at most (1 - level) / 2.
struct QuantileInterval {
  Interval interval;
  double coverage = 0;  ///< Actual confidence: at least the requested level.
};

/// None if there are too few values for one of its ends: for the median at 95 %, fewer than six.
std::optional<QuantileInterval> quantile_interval(std::vector<double> values, double p,
                                                  double level = kLevel);

}  // namespace results::statistics
