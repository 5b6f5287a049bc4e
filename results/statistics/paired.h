#pragma once

#include <optional>
#include <span>

#include "results/statistics/bootstrap.h"
#include "results/statistics/interval.h"

namespace results::statistics {

/// Two settings, each run with the same seeds (common random numbers): what the second changes,
/// from the differences of its runs to their partners. What both have in common cancels out.
struct PairedComparison {
  Moments difference;       ///< Second minus first.
  Interval interval;        ///< Of the mean difference.
  std::optional<double> t;  ///< Of the paired t test; none if all differences are equal.
  std::optional<double> p;  ///< Two-sided: of a |t| as large or larger if nothing was changed.
  /// Between partners; the nearer to 1, the more the common random numbers gained. None if one
  /// side does not vary.
  std::optional<double> correlation;
};

/// The interval is Student's; of shares it is that of a share of the differences, which are -1 ..
/// 1, and so stays within that. None for fewer than two pairs. @pre both are equally long, partners
/// at equal places.
/// @param support  of the values.
std::optional<PairedComparison> compare_pairs(std::span<const double> first,
                                              std::span<const double> second,
                                              Support::Kind support = Support::Kind::kReal,
                                              double level = kLevel);

/// The bootstrap interval (BCa; percentile where that has none) of the mean difference. None for
/// fewer than two pairs. @pre as above; resamples.count() == first.size().
std::optional<Interval> bootstrap_pairs(std::span<const double> first,
                                        std::span<const double> second, const Resamples& resamples,
                                        double level = kLevel);

}  // namespace results::statistics
