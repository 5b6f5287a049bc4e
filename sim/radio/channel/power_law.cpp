#include "sim/radio/channel/power_law.h"

#include "hal/types/math.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const PowerLawConfig& /*config*/, const PropagationConfig& air,
                                     const Ground& /*ground*/) {
  return std::make_unique<PowerLaw>(air.wavelength, air.path_loss_exponent);
}

/// Of a transmitter with this power [mW], were the law true there.
double PowerLaw::at_one_metre(double power) const {
  return power * wavelength_ * wavelength_ / (16 * hal::math::kPi * hal::math::kPi);
}

hal::Milliwatts PowerLaw::after(hal::Milliwatts power, const Path& path) const {
  const double near = at_one_metre(power.value);
  const double loss = to_the(exponent_, path.distance_squared);
  return hal::Milliwatts{near < power.value * loss ? near / loss : power.value};
}

double PowerLaw::reach(hal::Milliwatts power, hal::Milliwatts least) const {
  return hal::math::pow(at_one_metre(power.value) / least.value, 1 / exponent_);
}

hal::Milliwatts Cutoff::after(hal::Milliwatts power, const Path& path) const {
  return path.distance_squared <= range_ * range_ ? power : hal::Milliwatts{};
}

}  // namespace sim::radio
