#include "sim/report/quantiles.h"

#include <algorithm>

#include "sim/statistics/quantile.h"

namespace sim::report {

std::optional<Quantiles> quantiles(std::vector<double> sample) {
  if (sample.empty()) return std::nullopt;
  std::sort(sample.begin(), sample.end());
  return Quantiles{.min = sample.front(),
                   .q1 = statistics::quantile_of_sorted(sample, 0.25),
                   .median = statistics::quantile_of_sorted(sample, 0.5),
                   .q3 = statistics::quantile_of_sorted(sample, 0.75),
                   .max = sample.back()};
}

}  // namespace sim::report
