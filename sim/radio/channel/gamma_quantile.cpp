#include "sim/radio/channel/gamma_quantile.h"

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"

namespace sim::radio {
namespace {

using hal::math::exp;
using hal::math::log;

constexpr int kPoints = 512;
constexpr double kLeast = 1e-8;  ///< Argument from which the table starts.
constexpr int kBisections = 60;
constexpr double kPrecision = 1e-15;

/// ln Gamma(x) by Stirling's series, used where its fourth term is below 1e-12.
double log_gamma(double x) {
  double shift = 0;
  for (; x < 15; ++x) shift += hal::math::log(x);
  const double r = 1 / x, r2 = r * r;
  const double series = r * (1.0 / 12 - r2 * (1.0 / 360 - r2 * (1.0 / 1260 - r2 / 1680)));
  return (x - 0.5) * hal::math::log(x) - x + 0.5 * hal::math::log(2 * hal::math::kPi) + series -
         shift;
}

/// ln(x^m e^-x / Gamma(m)).
double log_factor(double m, double x) { return m * hal::math::log(x) - x - log_gamma(m); }

/// P(m, x) by its power series (M. Abramowitz, I. A. Stegun, "Handbook of Mathematical Functions",
/// 6.5.29).
double lower_gamma(double m, double x) {
  double term = 1 / m, sum = term;
  for (double k = m + 1; term > kPrecision * sum; ++k) {
    term *= x / k;
    sum += term;
  }
  return hal::math::exp(log_factor(m, x)) * sum;
}

/// Q(m, x) divided by exp(log_factor(m, x)): the continued fraction (ibid., 6.5.31), evaluated
/// forwards as the ratio of its convergents' numerators and denominators.
double upper_gamma_fraction(double m, double x) {
  double a = 1, b = x + 1 - m;  // numerator and denominator of the last convergent
  double a_before = 0, b_before = 1;
  double value = a / b, last = 0;
  for (int k = 1; std::abs(value - last) > kPrecision * value && k < 1000; ++k) {
    const double numerator = k * (m - k), denominator = x + 2 * k + 1 - m;
    const double a_next = denominator * a + numerator * a_before;
    const double b_next = denominator * b + numerator * b_before;
    a_before = a / b_next;
    b_before = b / b_next;
    a = a_next / b_next;
    b = 1;
    last = value;
    value = a;
  }
  return value;
}

/// ln(-ln Q(m, x)): logarithm of the exponential variate that is exceeded with the same
/// probability.
double log_exponential(double m, double x) {
  if (x < 1e-3 * std::min(m, 1.0)) {  // here -ln(1 - P) = P + P^2 / 2
    const double p = lower_gamma(m, x);
    return hal::math::log(p * (1 + 0.5 * p));
  }
  return hal::math::log(-log_upper_gamma(m, x));
}

/// Logarithm of the gamma variate of mean 1 whose log_exponential() is `wanted`.
double solve(double m, double wanted) {
  double low = -200, high = 10;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (log_exponential(m, m * hal::math::exp(middle)) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double log_upper_gamma(double m, double x) {
  if (x <= 0) return 0;
  if (x < m + 1) return hal::math::log(1 - lower_gamma(m, x));
  return log_factor(m, x) + hal::math::log(upper_gamma_fraction(m, x));
}

GammaQuantile::GammaQuantile(double m, double most)
    : m_(m),
      first_(hal::math::log(kLeast)),
      step_((hal::math::log(most) - first_) / (kPoints - 1)) {
  values_.reserve(kPoints);
  for (int i = 0; i < kPoints; ++i) values_.push_back(solve(m, first_ + i * step_));
}

double GammaQuantile::operator()(double exponential) const {
  if (exponential <= 0) return 0;
  const double place = (hal::math::log(exponential) - first_) / step_;
  // For small x, P(m, x) is proportional to x^m.
  if (place <= 0) return hal::math::exp(values_.front() + place * step_ / m_);
  const auto i = std::min(static_cast<std::size_t>(place), values_.size() - 2);
  const double share = std::min(place - static_cast<double>(i), 1.0);
  return hal::math::exp(values_[i] + share * (values_[i + 1] - values_[i]));
}

}  // namespace sim::radio
