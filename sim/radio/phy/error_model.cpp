#include "sim/radio/phy/error_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/types/math.h"

namespace sim::radio {
namespace {

constexpr double kMobilityFrameworkBandwidth = 2e6;  // Hz
/// Above this x, 1 - BER with BER <= exp(-x) / 2 is 1 as a double.
constexpr double kIsCertain = 38;
/// From this z on, 1 - erfc(z) is 1 as a double: erfc(6) = 2.2e-17.
constexpr double kErrorFunctionIsOne = 6;

double mobility_framework_ber(double sinr, double rate) {
  const double per_bit = sinr * kMobilityFrameworkBandwidth / rate;
  if (rate <= 2e6) return 0.5 * hal::math::exp(-per_bit);
  if (rate <= 5.5e6) return 0.5 * (1 - 1 / std::sqrt(16.0)) * hal::math::erfc(per_bit);
  return 0.25 * (1 - 1 / std::sqrt(256.0)) * hal::math::erfc(per_bit);
}

/// Energy per bit over noise density: 22 MHz / 1 Mb/s.
double dbpsk_ber(double sinr) {
  return 22 * sinr > kIsCertain ? 0 : 0.5 * hal::math::exp(-22 * sinr);
}

/// Asymptotic form of Miller's expression for differentially detected QPSK.
double dqpsk_ber(double sinr) {
  const double x = 11 * sinr;
  if (x <= 0) return 0.5;
  const double root2 = std::sqrt(2.0);
  if ((2 - root2) * x > kIsCertain) return 0;
  const double factor = (root2 + 1) / std::sqrt(8 * hal::math::kPi * root2);
  return std::min(0.5, factor / std::sqrt(x) * hal::math::exp(-(2 - root2) * x));
}

/// Probability that a symbol of 16-ary biorthogonal keying is received correctly, where
/// beta^2 / 2 is symbol energy over noise density: J. G. Proakis, "Digital Communications", 4th
/// edition, 2001, section 5.2.2: integral from -beta of (2 Phi(x + beta) - 1)^7 phi(x).
/// Simpson's rule; 128 intervals agree with 1600 to 1e-10.
double biorthogonal_integral(double beta) {
  constexpr int kIntervals = 128;
  constexpr double kEdge = 10;  // phi(10) = 8e-23
  const double low = std::max(-beta, -kEdge);
  const double step = (kEdge - low) / kIntervals;
  double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double x = low + i * step;
    const double z = (x + beta) / std::sqrt(2.0);
    // 2 Phi(x + beta) - 1
    const double inside = z >= kErrorFunctionIsOne ? 1 : 1 - hal::math::erfc(z);
    const double cube = inside * inside * inside;
    const double weight = i == 0 || i == kIntervals ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * cube * cube * inside * hal::math::exp(-x * x / 2);
  }
  return std::clamp(sum * step / 3 / std::sqrt(2 * hal::math::kPi), 0.0, 1.0);
}

/// Values of that integral at points 1/64 apart, with Lagrange interpolation through the six
/// nearest: agrees with the direct sum to 1e-12 at a hundredth of the cost, which every interval of
/// a reception would have to pay.
class BiorthogonalSuccess {
 public:
  BiorthogonalSuccess() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i] = biorthogonal_integral((static_cast<double>(i) - kBefore) / kPerUnit);
    }
  }

  /// @param energy  symbol energy over noise density, up to kMostEnergy.
  double operator()(double energy) const {
    const double place = std::sqrt(2 * energy) * kPerUnit;
    // Index into values_; kBefore points lie before `place`.
    const auto first = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(first);
    const double a = t + 2, b = t + 1, c = t - 1, d = t - 2, e = t - 3;
    const double* const y = values_.data() + first;
    return (b * t * c * d * e * -y[0] + 5 * a * t * c * d * e * y[1] -
            10 * a * b * c * d * e * y[2] + 10 * a * b * t * d * e * y[3] -
            5 * a * b * t * c * e * y[4] + a * b * t * c * d * y[5]) /
           120;
  }

  /// Above this, an error is less probable than 1e-16: 14 Q(sqrt(80)) = 3e-18.
  static constexpr double kMostEnergy = 80;

 private:
  static constexpr int kPerUnit = 64;
  static constexpr int kBefore = 2;
  /// sqrt(2 * 80) * 64 = 809.5; two points before and three after.
  std::array<double, 817> values_{};
};

double biorthogonal_success(double energy) {
  static const BiorthogonalSuccess success;
  return energy >= BiorthogonalSuccess::kMostEnergy ? 1 : std::clamp(success(energy), 0.0, 1.0);
}

/// 1.375 million symbols per second, so a symbol has 22 / 1.375 = 16 times the SINR; differential
/// detection costs half of it, and at 11 Mb/s two signals share the rest.
double cck_success(double sinr, double rate, double bits) {
  const bool is_slower = rate <= 5.5e6;
  const double success = biorthogonal_success((is_slower ? 8 : 4) * sinr);
  return success >= 1 ? 1 : hal::math::pow(success, is_slower ? bits / 4 : 2 * bits / 8);
}

}  // namespace

double success_probability(ErrorModel model, double sinr, hal::BitsPerSecond rate, double bits) {
  if (bits <= 0) return 1;
  if (model == ErrorModel::kDsss && rate.value > 2e6) return cck_success(sinr, rate.value, bits);
  double error = 0;
  if (model == ErrorModel::kMobilityFramework) {
    error = mobility_framework_ber(sinr, rate.value);
  } else {
    error = rate.value <= 1e6 ? dbpsk_ber(sinr) : dqpsk_ber(sinr);
  }
  const double success = 1 - error;
  return success >= 1 ? 1 : hal::math::pow(success, bits);
}

}  // namespace sim::radio
