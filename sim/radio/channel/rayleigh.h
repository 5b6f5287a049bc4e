#pragma once

#include "sim/radio/channel/fading.h"

namespace sim::radio {

/// Fading without a direct path.
struct RayleighConfig : FadingConfig {
  static constexpr std::string_view kModel = "rayleigh";
};

std::unique_ptr<const PathLoss> make(const RayleighConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

/// No direct ray: power exponential.
class RayleighFading final : public Fading {
 public:
  RayleighFading(const RayleighConfig& config, hal::Metres wavelength)
      : Fading(config, wavelength) {}
  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double most_gain() const override { return kWaves; }
};

}  // namespace sim::radio
