#include "sim/radio/channel/antenna.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sim::radio {
namespace {

constexpr double kWeakest = 1e-10;
constexpr double kDegree = hal::math::kPi / 180;

double ratio_of(double decibels) { return hal::math::pow(10, decibels / 10); }

hal::Vec3 cross(const hal::Vec3& a, const hal::Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double azimuth_of(const hal::Vec3& d) { return hal::math::atan2(d.y, d.x); }
double elevation_of(const hal::Vec3& d) {
  return hal::math::atan2(d.z, std::sqrt(d.x * d.x + d.y * d.y));
}

std::vector<double> distinct(const std::vector<AntennaRow>& rows, double AntennaRow::*member) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const AntennaRow& row : rows) values.push_back(row.*member);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// Where a value lies among ascending ones: between two of them, and how far on the way.
struct Between {
  std::size_t low = 0, high = 0;
  double share = 0;
};
Between place_among(const std::vector<double>& values, double value) {
  const auto above = std::ranges::upper_bound(values, value);
  if (above == values.begin()) return {};
  const auto low = static_cast<std::size_t>(above - values.begin()) - 1;
  if (above == values.end()) return {low, low, 0};
  return {low, low + 1, (value - values[low]) / (*above - values[low])};
}
/// The same on a circle.
Between place_around(const std::vector<double>& angles, double angle) {
  constexpr double kTurn = 2 * hal::math::kPi;
  while (angle < angles.front()) angle += kTurn;
  while (angle >= angles.front() + kTurn) angle -= kTurn;
  Between place = place_among(angles, angle);
  if (place.low + 1 < angles.size() || angles.size() == 1) return place;
  const double gap = angles.front() + kTurn - angles.back();
  return {place.low, 0, gap > 0 ? (angle - angles.back()) / gap : 0};
}

}  // namespace

std::vector<WrongAntennaRow> wrong_rows(const std::vector<AntennaRow>& rows) {
  std::vector<WrongAntennaRow> wrong;
  const auto azimuths = distinct(rows, &AntennaRow::azimuth);
  const auto elevations = distinct(rows, &AntennaRow::elevation);
  std::vector<bool> is_there(azimuths.size() * elevations.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto a = std::ranges::lower_bound(azimuths, rows[i].azimuth) - azimuths.begin();
    const auto e = std::ranges::lower_bound(elevations, rows[i].elevation) - elevations.begin();
    const auto cell = static_cast<std::size_t>(e) * azimuths.size() + static_cast<std::size_t>(a);
    if (is_there[cell]) wrong.push_back({i, "this direction is there already"});
    is_there[cell] = true;
  }
  if (!rows.empty() && wrong.empty() && rows.size() != is_there.size())
    wrong.push_back({rows.size() - 1, "not every elevation has every azimuth"});
  if (!rows.empty() && azimuths.back() - azimuths.front() > 360)
    wrong.push_back({rows.size() - 1, "azimuths go round more than once"});
  return wrong;
}

AntennaPattern::AntennaPattern(const AntennaConfig& config) : config_(config) {
  if (std::holds_alternative<DipoleAntenna>(config)) most_ = towards({1, 0, 0});
  if (const auto* const table = std::get_if<TableAntenna>(&config)) arrange(*table);
}

void AntennaPattern::arrange(const TableAntenna& table) {
  azimuths_ = distinct(table.rows, &AntennaRow::azimuth);
  elevations_ = distinct(table.rows, &AntennaRow::elevation);
  auto rows = table.rows;
  std::ranges::sort(rows, [](const AntennaRow& a, const AntennaRow& b) {
    return std::pair(a.elevation, a.azimuth) < std::pair(b.elevation, b.azimuth);
  });
  most_ = kWeakest;
  for (const AntennaRow& row : rows) {
    decibels_.push_back(row.gain);
    most_ = std::max(most_, ratio_of(row.gain));
  }
  for (double& angle : azimuths_) angle *= kDegree;
  for (double& angle : elevations_) angle *= kDegree;
}

double AntennaPattern::towards(const hal::Vec3& direction) const {
  const double gain = std::visit([&](const auto& one) { return of(one, direction); }, config_);
  return std::max(gain, kWeakest);
}

double AntennaPattern::of(const DipoleAntenna& /*dipole*/, const hal::Vec3& d) const {
  constexpr double kDirectivity = 1.640922377;  // 4 / Cin(2 pi)
  constexpr double kAlong = 1e-12;              // sin^2: the limit is 0
  const double length_squared = hal::dot(d, d);
  const double cos_squared = d.z * d.z / length_squared;
  const double sin_squared = 1 - cos_squared;
  if (sin_squared < kAlong) return 0;
  const double field = hal::math::cos(hal::math::kPi / 2 * std::sqrt(cos_squared));
  return kDirectivity * field * field / sin_squared;
}

double AntennaPattern::of(const BeamAntenna& beam, const hal::Vec3& d) const {
  const double ca = hal::math::cos(beam.azimuth), sa = hal::math::sin(beam.azimuth);
  const double ahead = ca * d.x + sa * d.y, left = ca * d.y - sa * d.x;
  const double ce = hal::math::cos(beam.elevation), se = hal::math::sin(beam.elevation);
  const hal::Vec3 from_boresight{ce * ahead + se * d.z, left, ce * d.z - se * ahead};
  const double a = azimuth_of(from_boresight) / beam.width;
  const double e = elevation_of(from_boresight) / beam.height;
  return ratio_of(-std::min(12 * a * a + 12 * e * e, beam.back.value));
}

double AntennaPattern::of(const TableAntenna& /*table*/, const hal::Vec3& d) const {
  const Between around = place_around(azimuths_, azimuth_of(d));
  const Between up = place_among(elevations_, elevation_of(d));
  const auto row = [&](std::size_t elevation) {
    const double* const gains = &decibels_[elevation * azimuths_.size()];
    return gains[around.low] + around.share * (gains[around.high] - gains[around.low]);
  };
  const double low = row(up.low);
  return ratio_of(low + up.share * (row(up.high) - low));
}

double DirectedAntenna::towards(const hal::Vec3& way) const {
  if (way == hal::Vec3{}) return 1;
  // The inverse of the attitude turns the way into the body's frame.
  const hal::Vec3 axis{-attitude_[1], -attitude_[2], -attitude_[3]};
  const hal::Vec3 t = 2 * cross(axis, way);
  return pattern_.towards(way + attitude_[0] * t + cross(axis, t));
}

}  // namespace sim::radio
