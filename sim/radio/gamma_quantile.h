#pragma once

#include <vector>

namespace sim::radio {

/// The value of a gamma distribution with shape m and mean 1 that is as likely to be exceeded as a
/// value of the exponential distribution with mean 1. From a table, error below 0.1 %; it never
/// falls as its argument grows.
class GammaQuantile {
 public:
  /// @param m  0.5 .. 50.  @param most  the largest argument it is asked for, > 1.
  GammaQuantile(double m, double most);

  /// @param exponential  0 .. most.
  double operator()(double exponential) const;

 private:
  double m_;
  double first_, step_;         ///< Natural logarithms of the table's arguments.
  std::vector<double> values_;  ///< Natural logarithms.
};

/// ln Q(m, x), the logarithm of the regularised upper incomplete gamma function: the probability
/// that a gamma variate of shape m and scale 1 exceeds x. @param m  > 0. @param x  >= 0.
double log_upper_gamma(double m, double x);

}  // namespace sim::radio
