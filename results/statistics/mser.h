#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace results::statistics {

/// Where the warm-up of a series ends.
struct WarmUp {
  std::size_t values = 0;  ///< So many are to be left out at the start: a multiple of the batch.
  /// The best cut is the last one that was looked at: the series may never have left its warm-up,
  /// and none of it is to be trusted.
  bool is_too_short = false;
};

/// The marginal standard error rule on means of batches (K. P. White, "An Effective Truncation
/// Heuristic for Bias Reduction in Simulation Output", Simulation 69(6), 1997; MSER-5: batches of
/// five, S. C. Spratt, 1998): the cut, within the first half, that makes the squared deviations of
/// what remains, over the square of its number, least; the earliest of equals. Values that do not
/// fill a batch at the end are not looked at. None for fewer than two batches.
/// @pre batch > 0.
std::optional<WarmUp> mser(std::span<const double> series, std::size_t batch = 5);

}  // namespace results::statistics
