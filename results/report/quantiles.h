#pragma once

#include <optional>
#include <vector>

namespace results::report {

/// Minimum, quartiles and maximum of a sample.
struct Quantiles {
  double min = 0, q1 = 0, median = 0, q3 = 0, max = 0;
};

/// Quantiles of type 7: linear between order statistics, the p-quantile at position (n - 1) p
/// counted from 0 (R. J. Hyndman and Y. Fan, "Sample Quantiles in Statistical Packages", The
/// American Statistician 50(4), 1996). None for an empty sample.
std::optional<Quantiles> quantiles(std::vector<double> sample);

}  // namespace results::report
