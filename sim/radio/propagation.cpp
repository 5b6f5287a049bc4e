#include "sim/radio/propagation.h"

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"

namespace sim::radio {
namespace {

constexpr double kSpeedOfLight = 299792458.0;  // m/s
constexpr double kAnyPower = 1e-300;           // mW

bool has_no_physics(const RadioConfig& config) {
  return config.profile == Profile::kDisk || config.profile == Profile::kIdeal;
}

double friis_constant(const RadioConfig& config) {
  const double lambda = config.wavelength.value;
  return config.tx_power.value * lambda * lambda / (16 * hal::math::kPi * hal::math::kPi);
}

}  // namespace

hal::Dbm to_dbm(hal::Milliwatts power) { return hal::Dbm{10 * hal::math::log10(power.value)}; }

hal::Milliwatts to_milliwatts(hal::Dbm level) {
  return hal::Milliwatts{hal::math::pow(10, level.value / 10)};
}

Propagation::Propagation(const RadioConfig& config, const Obstacles& obstacles)
    : obstacles_(config.obstacles && !has_no_physics(config) ? &obstacles : nullptr),
      disk_(has_no_physics(config)),
      delays_(config.propagation_delay && !disk_),
      tx_power_(config.tx_power.value),
      exponent_(config.path_loss_exponent),
      at_one_metre_(friis_constant(config)),
      sensitivity_(disk_ ? hal::Milliwatts{kAnyPower} : to_milliwatts(config.sensitivity)),
      floor_(disk_ ? hal::Milliwatts{kAnyPower} : to_milliwatts(config.interference_floor)),
      audible_(disk_ ? hal::Milliwatts{kAnyPower}
                     : to_milliwatts(std::min(config.sensitivity, config.cca_threshold))),
      reach_(disk_ ? config.range : distance_at(config.interference_floor)) {}

hal::Metres Propagation::distance_at(hal::Dbm level) const {
  return hal::Metres{hal::math::pow(at_one_metre_ / to_milliwatts(level).value, 1 / exponent_)};
}

hal::Milliwatts Propagation::free_space(double distance_squared) const {
  if (disk_) {
    const double range = reach_.value;
    return hal::Milliwatts{distance_squared <= range * range ? tx_power_ : 0};
  }
  const double loss = spread(distance_squared);
  return hal::Milliwatts{at_one_metre_ < tx_power_ * loss ? at_one_metre_ / loss : tx_power_};
}

/// Distance to the exponent; those of almost every scenario need no pow().
double Propagation::spread(double distance_squared) const {
  if (exponent_ == 2) return distance_squared;
  if (exponent_ == 3) return distance_squared * std::sqrt(distance_squared);
  if (exponent_ == 4) return distance_squared * distance_squared;
  return hal::math::pow(distance_squared, exponent_ / 2);
}

Propagation::Strength Propagation::strength(const Arrival& arrival) const {
  if (arrival.blocked || arrival.power >= audible_) return Strength::kAudible;
  return is_noticeable(arrival.power) ? Strength::kFaint : Strength::kNothing;
}

Propagation::Arrival Propagation::arrival(const hal::Vec3& from, const hal::Vec3& to) const {
  const double distance_squared = dot(to - from, to - from);
  const hal::Milliwatts free = free_space(distance_squared);
  Arrival result{.power = free};
  if (obstacles_ != nullptr && is_noticeable(free)) {
    const hal::Decibels loss = obstacles_->loss(from, to);
    if (loss.value > 0) {
      result.power = hal::Milliwatts{free.value * hal::math::pow(10, -loss.value / 10)};
    }
    result.blocked = is_receivable(free) && !is_receivable(result.power);
  }
  result.strength = strength(result);
  if (result.strength == Strength::kAudible) result.level = to_dbm(result.power);
  if (!is_noticeable(result.power)) result.power = {};
  if (delays_) result.delay = hal::from_seconds(std::sqrt(distance_squared) / kSpeedOfLight);
  return result;
}

}  // namespace sim::radio
