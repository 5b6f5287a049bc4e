#include "sim/radio/propagation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "hal/types/math.h"
#include "sim/radio/power_law.h"

namespace sim::radio {
namespace {

constexpr double kSpeedOfLight = 299792458.0;  // m/s
constexpr hal::Milliwatts kAnyPower{1e-300};

}  // namespace

hal::Dbm to_dbm(hal::Milliwatts power) { return hal::Dbm{10 * hal::math::log10(power.value)}; }

hal::Milliwatts to_milliwatts(hal::Dbm level) {
  return hal::Milliwatts{hal::math::pow(10, level.value / 10)};
}

Propagation::Propagation(const RadioConfig& config, const Obstacles& obstacles) {
  if (const WavesConfig* const waves = waves_of(config)) {
    add(*waves, obstacles);
  } else if (const auto* disk = std::get_if<DiskConfig>(&config)) {
    add(disk->range);
  } else {
    add(std::get<IdealConfig>(config).range);
  }
}

void Propagation::add(const WavesConfig& config, const Obstacles& obstacles) {
  const PropagationConfig& air = config.propagation;
  chain_.push_back(std::make_unique<PowerLaw>(air.wavelength, air.path_loss_exponent));
  if (air.obstacles) obstacles_ = &obstacles;
  delays_ = air.propagation_delay;
  sensitivity_ = to_milliwatts(config.receiver.sensitivity);
  floor_ = to_milliwatts(air.interference_floor);
  audible_ = to_milliwatts(std::min(config.receiver.sensitivity, config.receiver.cca_threshold));
}

void Propagation::add(hal::Metres range) {
  chain_.push_back(std::make_unique<Cutoff>(range));
  sensitivity_ = floor_ = audible_ = kAnyPower;
}

double Propagation::reach(hal::Milliwatts sent, hal::Milliwatts least) const {
  double reach = std::numeric_limits<double>::infinity();
  for (const auto& loss : chain_) reach = std::min(reach, loss->reach(sent, least));
  return reach;
}

Propagation::Strength Propagation::strength(const Arrival& arrival) const {
  if (arrival.blocked || arrival.power >= audible_) return Strength::kAudible;
  return arrival.power >= floor_ ? Strength::kFaint : Strength::kNothing;
}

Propagation::Arrival Propagation::arrival(hal::Milliwatts sent, const hal::Vec3& from,
                                          const hal::Vec3& to) const {
  const Path path(from, to);
  Arrival result{.power = sent};
  for (const auto& loss : chain_) result.power = loss->after(result.power, path);
  if (obstacles_ != nullptr && result.power >= floor_) {
    const hal::Milliwatts free = result.power;
    const hal::Decibels loss = obstacles_->loss(from, to);
    if (loss.value > 0) {
      result.power = hal::Milliwatts{free.value * hal::math::pow(10, -loss.value / 10)};
    }
    result.blocked = is_receivable(free) && !is_receivable(result.power);
  }
  result.strength = strength(result);
  if (result.strength == Strength::kAudible) result.level = to_dbm(result.power);
  if (result.power < floor_) result.power = {};
  if (delays_) result.delay = hal::from_seconds(std::sqrt(path.distance_squared) / kSpeedOfLight);
  return result;
}

}  // namespace sim::radio
