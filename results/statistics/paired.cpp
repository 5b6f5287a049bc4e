#include "results/statistics/paired.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "results/statistics/distributions.h"

namespace results::statistics {
namespace {

std::vector<double> differences_of(std::span<const double> first, std::span<const double> second) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < first.size(); ++i) differences.push_back(second[i] - first[i]);
  return differences;
}

/// A spread below this fraction of the largest value is taken for rounding error.
constexpr double kRounding = 1e-12;

double largest_of(std::span<const double> values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Whether a sum of squared deviations exceeds what rounding alone gives for equal values.
bool varies(double squares, std::span<const double> values) {
  const double rounding = kRounding * largest_of(values);
  return squares > rounding * rounding * static_cast<double>(values.size());
}

std::optional<double> correlation_of(std::span<const double> first,
                                     std::span<const double> second) {
  const double middle_1 = mean_of(first);
  const double middle_2 = mean_of(second);
  double squares_1 = 0;
  double squares_2 = 0;
  double products = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double off_1 = first[i] - middle_1;
    const double off_2 = second[i] - middle_2;
    squares_1 += off_1 * off_1;
    squares_2 += off_2 * off_2;
    products += off_1 * off_2;
  }
  if (!varies(squares_1, first) || !varies(squares_2, second)) return std::nullopt;
  return products / std::sqrt(squares_1 * squares_2);
}

std::optional<Interval> interval_of(const std::vector<double>& differences, Support::Kind support,
                                    double level) {
  if (support != Support::Kind::kShare) return mean_interval(differences, level);
  std::vector<double> shares;  // differences, scaled from -1 .. 1 to 0 .. 1
  shares.reserve(differences.size());
  for (const double difference : differences) shares.push_back((1 + difference) / 2);
  const auto interval = mean_interval(shares, {support, {}}, level);
  if (!interval) return std::nullopt;
  return Interval{2 * interval->low - 1, 2 * interval->high - 1};
}

}  // namespace

std::optional<PairedComparison> compare_pairs(std::span<const double> first,
                                              std::span<const double> second, Support::Kind support,
                                              double level) {
  const std::vector<double> differences = differences_of(first, second);
  const auto interval = interval_of(differences, support, level);
  if (!interval) return std::nullopt;
  PairedComparison comparison;
  comparison.difference = *moments(differences);
  comparison.interval = *interval;
  comparison.correlation = correlation_of(first, second);
  const Moments& of = comparison.difference;
  if (of.sd > kRounding * std::max(largest_of(first), largest_of(second))) {
    const auto count = static_cast<double>(of.count);
    comparison.t = of.mean / (of.sd / std::sqrt(count));
    comparison.p = 2 * student_t_cdf(-std::abs(*comparison.t), count - 1);
  }
  return comparison;
}

std::optional<Interval> bootstrap_pairs(std::span<const double> first,
                                        std::span<const double> second, const Resamples& resamples,
                                        double level) {
  const std::vector<double> differences = differences_of(first, second);
  if (differences.size() < 2) return std::nullopt;
  const std::vector<double> sorted = bootstrap(differences, resamples, mean_of);
  const auto bca = bca_interval(differences, sorted, mean_of, level);
  return bca ? *bca : percentile_interval(sorted, level);
}

}  // namespace results::statistics
