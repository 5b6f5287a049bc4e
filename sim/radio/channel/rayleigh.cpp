#include "sim/radio/channel/rayleigh.h"

#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const RayleighConfig& config, const PropagationConfig& air,
                                     const Ground& /*ground*/) {
  return std::make_unique<RayleighFading>(config, air.wavelength);
}

hal::Milliwatts RayleighFading::after(hal::Milliwatts power, const Path& path) const {
  return scattered(path).power() * power;
}

}  // namespace sim::radio
