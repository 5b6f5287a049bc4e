#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace results::statistics {

/// Where the warm-up of a series ends.
struct WarmUp {
  std::size_t values = 0;  ///< Number of values to drop at the start: a multiple of the batch size.
  /// The best cut is the last one examined: the series may never have left its warm-up, so none of
  /// it can be trusted.
  bool is_too_short = false;
};

/// The marginal standard error rule on batch means (K. P. White, "An Effective Truncation Heuristic
/// for Bias Reduction in Simulation Output", Simulation 69(6), 1997; MSER-5, with batches of five:
/// S. C. Spratt, 1998). The cut lies within the first half and minimises
///
///   sum of squared deviations of the remaining batch means / (number of remaining batch means)^2;
///
/// of equal minima, the earliest. Values at the end that do not fill a batch are ignored. None for
/// fewer than two batches.
/// @param batch  values per batch, > 0.
std::optional<WarmUp> mser(std::span<const double> series, std::size_t batch = 5);

}  // namespace results::statistics
