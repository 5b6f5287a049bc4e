#include "results/statistics/interval.h"

#include <algorithm>
#include <cmath>

#include "results/statistics/distributions.h"

namespace results::statistics {

std::optional<Moments> moments(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  const auto count = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  double mean = sum / count;
  double rest = 0;  // rounding error of the first pass
  for (const double value : values) rest += value - mean;
  mean += rest / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return Moments{.count = values.size(),
                 .mean = mean,
                 .sd = values.size() > 1 ? std::sqrt(squares / (count - 1)) : 0};
}

std::optional<Interval> mean_interval(std::span<const double> values, double level) {
  const auto of = moments(values);
  if (!of || of->count < 2) return std::nullopt;
  const auto count = static_cast<double>(of->count);
  const double half = student_t_quantile((1 + level) / 2, count - 1) * of->sd / std::sqrt(count);
  return Interval{of->mean - half, of->mean + half};
}

namespace {

/// The lower end of the interval of mu with (mean - mu)^2 <= k mu (1 - quadratic mu), `quadratic`
/// being 0 or 1. Computed from the product of the two ends: a difference would lose digits or fall
/// below 0.
double lower_end(double mean, double k, double quadratic) {
  const double middle = mean + k / 2;
  const double root = std::sqrt(k * mean * (1 - quadratic * mean) + k * k / 4);
  return mean == 0 ? 0 : mean * mean / (middle + root);
}

Interval share_interval(double mean, double k) {
  return {lower_end(mean, k, 1), 1 - lower_end(1 - mean, k, 1)};
}

Interval amount_interval(double mean, double k) {
  return {lower_end(mean, k, 0), mean + k / 2 + std::sqrt(k * mean + k * k / 4)};
}

bool is_within(std::span<const double> values, Support::Kind kind) {
  const auto [least, greatest] = std::ranges::minmax(values);
  return least >= 0 && (kind != Support::Kind::kShare || greatest <= 1);
}

}  // namespace

std::optional<Interval> mean_interval(std::span<const double> values, const Support& support,
                                      double level) {
  using Kind = Support::Kind;
  const auto of = moments(values);
  if (!of || of->count < 2) return std::nullopt;
  const Kind kind = support.kind;
  if (kind == Kind::kReal || !is_within(values, kind)) return mean_interval(values, level);
  const bool is_share = kind == Kind::kShare;
  const double mean = is_share ? std::min(of->mean, 1.0) : of->mean;
  const double variance = is_share ? mean * (1 - mean) : mean;  // for phi = 1
  const auto count = static_cast<double>(of->count);
  const double t = student_t_quantile((1 + level) / 2, count - 1);
  const double z = normal_quantile((1 + level) / 2);
  double k = variance > 0 ? t * t * of->sd * of->sd / (count * variance) : 0;
  if (kind == Kind::kCount && mean == 0) k = z * z / count;
  if (is_share && support.trials) k = std::max(k, z * z / *support.trials);
  return is_share ? share_interval(mean, k) : amount_interval(mean, k);
}

}  // namespace results::statistics
