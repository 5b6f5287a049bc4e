#include "sim/radio/channel/nakagami.h"

#include <algorithm>

#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const NakagamiConfig& config, const PropagationConfig& air,
                                     const Ground& /*ground*/) {
  return std::make_unique<NakagamiFading>(config, air.wavelength);
}

NakagamiFading::NakagamiFading(const NakagamiConfig& config, hal::Metres wavelength)
    : Fading(config, wavelength),
      by_distance_{GammaQuantile(config.m_near, kWaves), GammaQuantile(config.m_middle, kWaves),
                   GammaQuantile(config.m_far, kWaves)},
      middle_from_(config.middle_from.value * config.middle_from.value),
      far_from_(config.far_from.value * config.far_from.value) {}

hal::Milliwatts NakagamiFading::after(hal::Milliwatts power, const Path& path) const {
  const double d2 = path.distance_squared;
  const GammaQuantile& quantile = by_distance_[(d2 >= middle_from_) + (d2 >= far_from_)];
  return quantile(scattered(path).power()) * power;
}

double NakagamiFading::most_gain() const {
  double most = 1;
  for (const GammaQuantile& quantile : by_distance_) most = std::max(most, quantile(kWaves));
  return most;
}

}  // namespace sim::radio
