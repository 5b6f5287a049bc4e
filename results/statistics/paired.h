#pragma once

#include <optional>
#include <span>

#include "results/statistics/bootstrap.h"
#include "results/statistics/interval.h"

namespace results::statistics {

/// Comparison of two settings that were run with the same seeds (common random numbers), from the
/// differences between runs of equal seed. Variation that both runs of a pair share cancels out.
struct PairedComparison {
  Moments difference;       ///< Second minus first.
  Interval interval;        ///< Of the mean difference.
  std::optional<double> t;  ///< Of the paired t test; none if all differences are equal.
  std::optional<double> p;  ///< Two-sided p-value of that test.
  /// Correlation between the two runs of a pair. The nearer to 1, the more the common random
  /// numbers reduced the variance. None if the values of one side are all equal.
  std::optional<double> correlation;
};

/// The interval is Student's. For shares, whose differences are -1 .. 1, the differences are scaled
/// to 0 .. 1 and get the interval of a share, so that it stays within -1 .. 1. None for fewer than
/// two pairs.
/// @pre Both are equally long; runs of a pair have the same index.
/// @param support  of the values.
std::optional<PairedComparison> compare_pairs(std::span<const double> first,
                                              std::span<const double> second,
                                              Support::Kind support = Support::Kind::kReal,
                                              double level = kLevel);

/// The bootstrap interval of the mean difference: BCa, or the percentile interval where there is no
/// BCa interval. None for fewer than two pairs. @pre As above; resamples.count() == first.size().
std::optional<Interval> bootstrap_pairs(std::span<const double> first,
                                        std::span<const double> second, const Resamples& resamples,
                                        double level = kLevel);

}  // namespace results::statistics
