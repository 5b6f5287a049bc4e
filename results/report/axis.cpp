#include "results/report/axis.h"

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"

namespace results::report {
namespace {

constexpr double kRounding = 1e-9;  // share of a step or an axis that binary64 may be off by

}  // namespace

void Extent::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

Extent Extent::padded(double share) const {
  if (!(low <= high)) return {0, 1};
  const double span = high > low ? high - low : std::max(1e-12, std::abs(high) * 0.2);
  const double room = high > low ? share : std::max(share, 0.05);
  return {low - room * span, high + room * span};
}

Extent Extent::log_padded(double share) const {
  if (!(low <= high)) return {0.1, 1};
  const double decades = high > low ? hal::math::log10(high / low) : 1;
  const double room = hal::math::pow(10, share * decades);
  return {low / room, high * room};
}

double Axis::at(double value) const {
  if (!is_log) return from + (value - low) / (high - low) * (to - from);
  return from + hal::math::log10(value / low) / hal::math::log10(high / low) * (to - from);
}

bool Axis::is_drawable(double value) const {
  return std::isfinite(value) && (!is_log || value > 0);
}

bool Axis::holds(double value) const {
  if (!is_drawable(value)) return false;
  const double room = kRounding * std::abs(to - from);
  const double place = at(value);
  return std::min(from, to) - room <= place && place <= std::max(from, to) + room;
}

std::vector<double> ticks(double low, double high, int count) {
  if (!(high > low)) return {low};
  const double rough = (high - low) / count;
  const double power = hal::math::pow(10, std::floor(hal::math::log10(rough)));
  const double share = rough / power;
  const double step = power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
  if (!std::isfinite(step) || !(step > 0)) return {low, high};  // below the resolution of binary64
  std::vector<double> values;
  const double first = std::ceil(low / step - kRounding);
  const double room = std::floor(high / step + kRounding) - first;
  const auto steps = static_cast<int>(std::clamp(room, 0.0, 2.0 * count));
  for (int i = 0; i <= steps; ++i) values.push_back((first + i) * step);
  return values;
}

std::vector<double> log_ticks(double low, double high, int count) {
  const double first = hal::math::log10(low);
  const double last = hal::math::log10(high);
  const int every = std::max(1, static_cast<int>(std::ceil((last - first) / count)));
  const std::vector<double> factors =
      last - first < 2 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
  std::vector<double> values;
  for (int power = static_cast<int>(std::floor(first)); power <= last + kRounding; ++power) {
    if (power % every != 0) continue;
    for (const double factor : factors) {
      const double value = factor * hal::math::pow(10, power);
      if (value >= low * (1 - kRounding) && value <= high * (1 + kRounding))
        values.push_back(value);
    }
  }
  return values;
}

}  // namespace results::report
