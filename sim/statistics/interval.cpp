#include "sim/statistics/interval.h"

#include <cmath>

#include "sim/statistics/distributions.h"

namespace sim::statistics {

std::optional<Moments> moments(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  const auto count = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  double mean = sum / count;
  double rest = 0;  // what rounding took from the first pass
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

}  // namespace sim::statistics
