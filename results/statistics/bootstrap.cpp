#include "results/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/types/random.h"
#include "results/statistics/distributions.h"
#include "results/statistics/quantile.h"

namespace results::statistics {
namespace {

/// The acceleration: a sixth of the skewness of the jackknife values (Efron and Tibshirani,
/// equation 14.15).
double acceleration(std::span<const double> values, const Statistic& statistic) {
  std::vector<double> without;
  std::vector<double> left(values.begin() + 1, values.end());
  for (std::size_t i = 0; i < values.size(); ++i) {
    without.push_back(statistic(left));
    if (i + 1 < values.size()) left[i] = values[i];
  }
  const double mean = mean_of(without);
  double squares = 0;
  double cubes = 0;
  for (const double one : without) {
    const double off = mean - one;
    squares += off * off;
    cubes += off * off * off;
  }
  return squares > 0 ? cubes / (6 * squares * std::sqrt(squares)) : 0;
}

}  // namespace

Resamples::Resamples(std::size_t count, std::size_t resamples, std::uint64_t seed,
                     std::string_view stream)
    : count_(count), indices_(count * resamples) {
  hal::RandomStream random(seed, stream);
  for (std::uint32_t& index : indices_) index = random.below(static_cast<std::uint32_t>(count));
}

std::string Resamples::csv() const {
  std::string text;
  for (std::size_t i = 0; i < indices_.size(); ++i) {
    text += std::to_string(indices_[i]);
    text += (i + 1) % count_ == 0 ? '\n' : ',';
  }
  return text;
}

std::vector<double> bootstrap(std::span<const double> values, const Resamples& resamples,
                              const Statistic& statistic) {
  std::vector<double> results;
  results.reserve(resamples.size());
  std::vector<double> resample(values.size());
  for (std::size_t i = 0; i < resamples.size(); ++i) {
    std::ranges::transform(resamples[i], resample.begin(),
                           [&](std::uint32_t index) { return values[index]; });
    results.push_back(statistic(resample));
  }
  std::sort(results.begin(), results.end());
  return results;
}

Interval percentile_interval(std::span<const double> sorted, double level) {
  return {quantile_of_sorted(sorted, (1 - level) / 2), quantile_of_sorted(sorted, (1 + level) / 2)};
}

std::optional<Interval> bca_interval(std::span<const double> values, std::span<const double> sorted,
                                     const Statistic& statistic, double level) {
  if (values.size() < 2 || sorted.empty()) return std::nullopt;
  const auto below = std::ranges::lower_bound(sorted, statistic(values)) - sorted.begin();
  if (below == 0 || below == std::ssize(sorted)) return std::nullopt;
  const double bias =
      normal_quantile(static_cast<double>(below) / static_cast<double>(sorted.size()));
  const double skew = acceleration(values, statistic);
  const auto end = [&](double p) {
    const double z = bias + normal_quantile(p);
    return quantile_of_sorted(sorted, normal_cdf(bias + z / (1 - skew * z)));
  };
  return Interval{end((1 - level) / 2), end((1 + level) / 2)};
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double median_of(std::span<const double> values) {
  return quantile({values.begin(), values.end()}, 0.5)
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace results::statistics
