#include "results/statistics/quantile.h"

#include <algorithm>
#include <cmath>

#include "results/statistics/distributions.h"

namespace results::statistics {

double quantile_of_sorted(std::span<const double> sorted, double p) {
  const double place = static_cast<double>(sorted.size() - 1) * p;
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

std::optional<double> quantile(std::vector<double> values, double p) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, p);
}

std::optional<QuantileInterval> quantile_interval(std::vector<double> values, double p,
                                                  double level) {
  const auto count = static_cast<int>(values.size());
  const double tail = (1 - level) / 2;
  // Ranks count from 1. Rank `low` is above the quantile if fewer than `low` values are below it.
  int low = 0;
  while (low < count && binomial_cdf(low, count, p) <= tail) ++low;
  int high = count + 1;
  while (high > 1 && 1 - binomial_cdf(high - 2, count, p) <= tail) --high;
  if (low < 1 || high > count || low >= high) return std::nullopt;
  std::sort(values.begin(), values.end());
  return QuantileInterval{
      .interval = {values[static_cast<std::size_t>(low) - 1],
                   values[static_cast<std::size_t>(high) - 1]},
      .coverage = binomial_cdf(high - 1, count, p) - binomial_cdf(low - 1, count, p)};
}

}  // namespace results::statistics
