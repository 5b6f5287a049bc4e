#pragma once

#include <algorithm>
#include <cmath>

#include "hal/node/devices/battery.h"

namespace tests {

/// s in which a battery falls from one energy to another, by Simpson's rule over dt = dE / (U I).
/// I(U) has a root that begins at the voltage where the load can just be fed, so that the rule goes
/// over its square root, in which it is smooth: E = kink +- s^2.
class BatteryQuadrature {
 public:
  BatteryQuadrature(const hal::node::devices::Battery& one, double watts)
      : one_(one),
        watts_(watts),
        slope_((one.full_voltage - one.empty_voltage) / one.capacity),
        kink_((2 * std::sqrt(one.resistance * watts) - one.empty_voltage) / slope_) {}

  /// @param from, to  J, falling.
  double seconds(double from, double to, int intervals) const {
    double sum = 0;
    if (to < kink_)
      sum += part(-1, std::sqrt(kink_ - std::min(from, kink_)), std::sqrt(kink_ - to), intervals);
    if (from > kink_)
      sum += part(1, std::sqrt(std::max(to, kink_) - kink_), std::sqrt(from - kink_), intervals);
    return sum;
  }

 private:
  /// W out of the charge.
  double power(double joules) const {
    const double u = one_.empty_voltage + slope_ * joules;
    const double r = one_.resistance;
    const double square = u * u - 4 * r * watts_;
    return u * (square < 0 ? u / (2 * r) : 2 * watts_ / (u + std::sqrt(square)));
  }
  double part(int sign, double from, double to, int intervals) const {
    const double h = (to - from) / intervals;
    double sum = 0;
    for (int i = 0; i <= intervals; ++i) {
      const double s = from + i * h;
      const int weight = i == 0 || i == intervals ? 1 : 2 + 2 * (i % 2);
      sum += weight * 2 * s / power(kink_ + sign * s * s);
    }
    return h / 3 * sum;
  }

  hal::node::devices::Battery one_;
  double watts_, slope_, kink_;
};

}  // namespace tests
