#include "sim/radio/fading.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::radio {
namespace {

constexpr double kTurn = 2 * hal::math::kPi;

double squared(double x) { return x * x; }

}  // namespace

double Fading::reach(hal::Milliwatts, hal::Milliwatts) const {
  return std::numeric_limits<double>::infinity();
}

Fading::Wave Fading::scattered(const Path& path) const {
  hal::RandomStream random(path.link(), "fading");
  const hal::Vec3 way = path.second().position - path.first().position;
  const double turns_here_x = way.x / wavelength_, turns_here_y = way.y / wavelength_;
  const double turns_in_time = speed_ * hal::to_seconds(path.at - hal::Time{}) / wavelength_;
  Wave sum{0, 0};
  for (int i = 0; i < kWaves; ++i) {
    const double direction = kTurn * random.uniform();
    const double scatterer = kTurn * random.uniform();
    double turns = random.uniform() + turns_here_x * hal::math::cos(direction) +
                   turns_here_y * hal::math::sin(direction);
    if (speed_ > 0) turns += turns_in_time * hal::math::cos(scatterer);
    const double phase = kTurn * (turns - std::floor(turns));
    sum.in_phase += hal::math::cos(phase);
    sum.quadrature += hal::math::sin(phase);
  }
  const double scale = 1 / std::sqrt(static_cast<double>(kWaves));
  return {scale * sum.in_phase, scale * sum.quadrature};
}

Fading::Wave Fading::direct(const Path& path) const {
  const double turns = std::sqrt(path.distance_squared) / wavelength_;
  const double phase = kTurn * (turns - std::floor(turns));
  return {hal::math::cos(phase), hal::math::sin(phase)};
}

hal::Milliwatts RayleighFading::after(hal::Milliwatts power, const Path& path) const {
  const Wave wave = scattered(path);
  return (squared(wave.in_phase) + squared(wave.quadrature)) * power;
}

RicianFading::RicianFading(const RicianConfig& config, hal::Metres wavelength)
    : Fading(config, wavelength) {
  const double k = hal::math::pow(10, config.k.value / 10);
  direct_ = std::sqrt(k / (k + 1));
  scattered_ = std::sqrt(1 / (k + 1));
}

hal::Milliwatts RicianFading::after(hal::Milliwatts power, const Path& path) const {
  const Wave ray = direct(path), rest = scattered(path);
  return (squared(direct_ * ray.in_phase + scattered_ * rest.in_phase) +
          squared(direct_ * ray.quadrature + scattered_ * rest.quadrature)) *
         power;
}

double RicianFading::most_gain() const {
  return squared(direct_ + scattered_ * std::sqrt(static_cast<double>(kWaves)));
}

NakagamiFading::NakagamiFading(const NakagamiConfig& config, hal::Metres wavelength)
    : Fading(config, wavelength),
      by_distance_{GammaQuantile(config.m_near, kWaves), GammaQuantile(config.m_middle, kWaves),
                   GammaQuantile(config.m_far, kWaves)},
      middle_from_(squared(config.middle_from.value)),
      far_from_(squared(config.far_from.value)) {}

hal::Milliwatts NakagamiFading::after(hal::Milliwatts power, const Path& path) const {
  const double d2 = path.distance_squared;
  const GammaQuantile& quantile = by_distance_[(d2 >= middle_from_) + (d2 >= far_from_)];
  const Wave wave = scattered(path);
  return quantile(squared(wave.in_phase) + squared(wave.quadrature)) * power;
}

double NakagamiFading::most_gain() const {
  double most = 1;
  for (const GammaQuantile& quantile : by_distance_) most = std::max(most, quantile(kWaves));
  return most;
}

}  // namespace sim::radio
