#include "hal/node/devices/infrared_curve.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace hal::node::devices {
namespace {

/// Volts per count of the 10-bit, 5 V converter to which the manufacturers' formulas refer.
constexpr double kVoltsPerCount = 5.0 / 1023.0;

void check_table(const std::vector<CurvePoint>& points) {
  if (points.size() < 2)
    throw std::invalid_argument(
        fmt::format("curve: {} point(s), at least 2 allowed", points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CurvePoint& p = points[i];
    if (!std::isfinite(p.metres) || !std::isfinite(p.volts) || p.metres <= 0 ||
        p.volts <= InfraredCurve::kFloorVolts)
      throw std::invalid_argument(
          fmt::format("curve: point {} ({} m, {} V): metres > 0 and volts > {} allowed", i,
                      p.metres, p.volts, InfraredCurve::kFloorVolts));
    if (i > 0 && (p.metres <= points[i - 1].metres || p.volts >= points[i - 1].volts))
      throw std::invalid_argument(
          fmt::format("curve: point {} ({} m, {} V): metres must ascend and volts descend", i,
                      p.metres, p.volts));
  }
}

}  // namespace

InfraredCurve InfraredCurve::gp2d12() {
  InfraredCurve curve(0.10, 0.80);
  curve.hyperbola_ = {kVoltsPerCount, 67.87, 0.04, 3};
  return curve;
}

InfraredCurve InfraredCurve::gp2d120() {
  InfraredCurve curve(0.04, 0.30);
  curve.hyperbola_ = {kVoltsPerCount, 29.14, 0.01, -5};
  return curve;
}

InfraredCurve InfraredCurve::table(std::vector<CurvePoint> points) {
  check_table(points);
  InfraredCurve curve(points.front().metres, points.back().metres);
  curve.points_ = std::move(points);
  return curve;
}

double InfraredCurve::reach() const { return max_range_ * volts_inside(max_range_) / kFloorVolts; }

double InfraredCurve::volts(double metres) const {
  if (metres < min_range_) return volts_inside(min_range_) * metres / min_range_;
  if (metres <= max_range_) return volts_inside(metres);
  return std::max(kFloorVolts, volts_inside(max_range_) * max_range_ / metres);
}

double InfraredCurve::metres(double volts) const {
  if (!(volts >= volts_inside(max_range_))) return std::numeric_limits<double>::quiet_NaN();
  if (volts >= volts_inside(min_range_)) return min_range_;
  return metres_inside(volts);
}

double InfraredCurve::volts_inside(double metres) const {
  if (points_.empty())
    return hyperbola_.scale * (hyperbola_.gain / (metres + hyperbola_.offset) + hyperbola_.bias);
  const auto right = std::lower_bound(points_.begin() + 1, points_.end() - 1, metres,
                                      [](const CurvePoint& p, double m) { return p.metres < m; });
  const CurvePoint& a = *(right - 1);
  const CurvePoint& b = *right;
  return a.volts + (b.volts - a.volts) * (metres - a.metres) / (b.metres - a.metres);
}

double InfraredCurve::metres_inside(double volts) const {
  if (points_.empty())
    return hyperbola_.gain / (volts / hyperbola_.scale - hyperbola_.bias) - hyperbola_.offset;
  const auto right = std::lower_bound(points_.begin() + 1, points_.end() - 1, volts,
                                      [](const CurvePoint& p, double v) { return p.volts > v; });
  const CurvePoint& a = *(right - 1);
  const CurvePoint& b = *right;
  return a.metres + (b.metres - a.metres) * (volts - a.volts) / (b.volts - a.volts);
}

double Converter::quantise(double volts) const {
  const double clamped = std::clamp(volts, 0.0, full_scale);
  if (bits == 0) return clamped;
  const double steps = static_cast<double>((1U << static_cast<unsigned>(bits)) - 1U);
  return std::floor(clamped / full_scale * steps + 0.5) * full_scale / steps;
}

}  // namespace hal::node::devices
