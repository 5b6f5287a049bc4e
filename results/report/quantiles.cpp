#include "results/report/quantiles.h"

#include <algorithm>

#include "results/statistics/quantile.h"

namespace results::report {

std::optional<Quantiles> quantiles(std::vector<double> sample) {
  if (sample.empty()) return std::nullopt;
  std::sort(sample.begin(), sample.end());
  return Quantiles{.min = sample.front(),
                   .q1 = statistics::quantile_of_sorted(sample, 0.25),
                   .median = statistics::quantile_of_sorted(sample, 0.5),
                   .q3 = statistics::quantile_of_sorted(sample, 0.75),
                   .max = sample.back()};
}

}  // namespace results::report
