#include "sim/radio/channel/rician.h"

#include <cmath>

#include "hal/types/math.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const RicianConfig& config, const PropagationConfig& air,
                                     const Ground& /*ground*/) {
  return std::make_unique<RicianFading>(config, air.wavelength);
}

RicianFading::RicianFading(const RicianConfig& config, hal::Metres wavelength)
    : Fading(config, wavelength) {
  const double k = hal::math::pow(10, config.k.value / 10);
  direct_ = std::sqrt(k / (k + 1));
  scattered_ = std::sqrt(1 / (k + 1));
}

hal::Milliwatts RicianFading::after(hal::Milliwatts power, const Path& path) const {
  const Wave ray = direct(path), rest = scattered(path);
  const Wave sum{direct_ * ray.in_phase + scattered_ * rest.in_phase,
                 direct_ * ray.quadrature + scattered_ * rest.quadrature};
  return sum.power() * power;
}

double RicianFading::most_gain() const {
  const double most = direct_ + scattered_ * std::sqrt(static_cast<double>(kWaves));
  return most * most;
}

}  // namespace sim::radio
