#include "sim/radio/error_model.h"

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"

namespace sim::radio {
namespace {

constexpr double kMobilityFrameworkBandwidth = 2e6;  // Hz
/// From here on a CCK symbol error is less likely than 1e-16: 14 Q(sqrt(4 * 20)) = 3e-18.
constexpr double kCckIsCertain = 20;

double mobility_framework_ber(double sinr, double rate) {
  const double per_bit = sinr * kMobilityFrameworkBandwidth / rate;
  if (rate <= 2e6) return 0.5 * hal::math::exp(-per_bit);
  if (rate <= 5.5e6) return 0.5 * (1 - 1 / std::sqrt(16.0)) * hal::math::erfc(per_bit);
  return 0.25 * (1 - 1 / std::sqrt(256.0)) * hal::math::erfc(per_bit);
}

/// Energy per bit over noise density: 22 MHz / 1 Mb/s.
double dbpsk_ber(double sinr) { return 0.5 * hal::math::exp(-22 * sinr); }

/// Asymptotic form of Miller's expression for differentially detected QPSK.
double dqpsk_ber(double sinr) {
  const double x = 11 * sinr;
  if (x <= 0) return 0.5;
  const double root2 = std::sqrt(2.0);
  const double factor = (root2 + 1) / std::sqrt(8 * hal::math::kPi * root2);
  return std::min(0.5, factor / std::sqrt(x) * hal::math::exp(-(2 - root2) * x));
}

/// Probability that a symbol of 16-ary biorthogonal keying is received correctly, `energy` being
/// symbol energy over noise density: J. G. Proakis, "Digital Communications", 4th edition, 2001,
/// section 5.2.2: integral from -beta of (2 Phi(x + beta) - 1)^7 phi(x), beta = sqrt(2 energy).
/// Simpson's rule; 128 intervals agree with 400 to 1e-11.
double biorthogonal_success(double energy) {
  constexpr int kIntervals = 128;
  constexpr double kEdge = 10;  // phi(10) = 8e-23
  const double beta = std::sqrt(2 * energy);
  const double low = std::max(-beta, -kEdge);
  const double step = (kEdge - low) / kIntervals;
  double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double x = low + i * step;
    const double inside = 1 - hal::math::erfc((x + beta) / std::sqrt(2.0));  // 2 Phi(x + beta) - 1
    const double cube = inside * inside * inside;
    const double weight = i == 0 || i == kIntervals ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * cube * cube * inside * hal::math::exp(-x * x / 2);
  }
  return std::clamp(sum * step / 3 / std::sqrt(2 * hal::math::kPi), 0.0, 1.0);
}

/// 1.375 million symbols a second, so a symbol has 22 / 1.375 = 16 times the SINR; differential
/// detection costs half of it, and at 11 Mb/s two signals share the rest.
double cck_success(double sinr, double rate, double bits) {
  if (sinr >= kCckIsCertain) return 1;
  if (rate <= 5.5e6) return hal::math::pow(biorthogonal_success(8 * sinr), bits / 4);
  return hal::math::pow(biorthogonal_success(4 * sinr), 2 * bits / 8);
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
  return error <= 0 ? 1 : hal::math::pow(1 - error, bits);
}

}  // namespace sim::radio
