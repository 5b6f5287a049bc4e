#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "results/statistics/interval.h"

namespace results::statistics {

/// A quantile of the values of several clusters together.
struct ClusteredQuantile {
  double value = 0;                    ///< Of type 7: quantile_of_sorted().
  std::optional<Interval> interval{};  ///< None: fewer than two clusters have values.
  std::size_t clusters = 0;            ///< That have values.
};

/// The p-quantile of all values of independent clusters, such as runs, whose values depend on each
/// other: each value counts alike.
///
/// The interval is that of R. S. Woodruff ("Confidence Intervals for Medians and Other Position
/// Measures", Journal of the American Statistical Association 47, 1952): the share of values at or
/// below the quantile is estimated with its interval, whose ends are the orders of the quantiles at
/// the ends of the result. The share is a ratio of sums over n clusters; with m_i values of cluster
/// i, M in all, and the shares F_i and F in the cluster and in all, mean_interval() for shares gets
///
///   p + n m_i (F_i - F) / M,   i = 1 .. n,
///
/// whose mean is p and whose variance is that of the ratio to first order (W. G. Cochran, "Sampling
/// Techniques", 3rd ed., 1977, section 6.3). An end that would be an order below 0 or above 1 is
/// the least or the greatest value.
/// @param clusters  the values of each, ascending. @param p  in (0, 1).
/// @return none if no cluster has values.
std::optional<ClusteredQuantile> clustered_quantile(
    std::span<const std::span<const double>> clusters, double p, double level = kLevel);

}  // namespace results::statistics
