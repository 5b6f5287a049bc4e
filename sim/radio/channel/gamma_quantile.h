#pragma once

#include <vector>

namespace sim::radio {

/// Maps a value of the exponential distribution with mean 1 to the value of the gamma distribution
/// with shape m and mean 1 that is exceeded with equal probability. Tabulated; relative error below
/// 0.1 %; never decreases as its argument grows.
class GammaQuantile {
 public:
  /// @param m  0.5 .. 50.  @param most  largest argument that will be used, > 1.
  GammaQuantile(double m, double most);

  /// @param exponential  0 .. `most`.
  double operator()(double exponential) const;

 private:
  double m_;
  double first_, step_;         ///< First natural logarithm of the table's arguments, and step.
  std::vector<double> values_;  ///< Natural logarithms of the results.
};

/// ln Q(m, x), the logarithm of the regularised upper incomplete gamma function: the probability
/// that a gamma variate of shape m and scale 1 exceeds x. @param m  > 0. @param x  >= 0.
double log_upper_gamma(double m, double x);

}  // namespace sim::radio
