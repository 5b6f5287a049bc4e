#pragma once

#include <cmath>
#include <vector>

#include "results/statistics/distributions.h"
#include "results/statistics/interval.h"

namespace sim::radio::test {

/// The 95 % interval of the difference of two means of independent runs, after B. L. Welch ("The
/// Generalization of 'Student's' Problem when Several Different Population Variances are Involved",
/// Biometrika 34, 1947), as a share of the second mean.
/// @pre Either has two values or more.
inline results::statistics::Interval relative_difference(const std::vector<double>& ours,
                                                         const std::vector<double>& theirs) {
  using namespace results::statistics;
  const Moments a = moments(ours).value(), b = moments(theirs).value();
  const double count_a = static_cast<double>(a.count), count_b = static_cast<double>(b.count);
  const double var_a = a.sd * a.sd / count_a, var_b = b.sd * b.sd / count_b;
  const double var = var_a + var_b;
  const double degrees =
      var * var / (var_a * var_a / (count_a - 1) + var_b * var_b / (count_b - 1));
  const double half = student_t_quantile((1 + kLevel) / 2, degrees) * std::sqrt(var);
  return {(a.mean - b.mean - half) / b.mean, (a.mean - b.mean + half) / b.mean};
}

}  // namespace sim::radio::test
