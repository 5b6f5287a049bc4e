#include "sim/report/quantiles.h"

#include <algorithm>
#include <cmath>

namespace sim::report {
namespace {

double quantile(const std::vector<double>& sorted, double p) {
  const double place = static_cast<double>(sorted.size() - 1) * p;
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::optional<Quantiles> quantiles(std::vector<double> sample) {
  if (sample.empty()) return std::nullopt;
  std::sort(sample.begin(), sample.end());
  return Quantiles{.min = sample.front(),
                   .q1 = quantile(sample, 0.25),
                   .median = quantile(sample, 0.5),
                   .q3 = quantile(sample, 0.75),
                   .max = sample.back()};
}

}  // namespace sim::report
