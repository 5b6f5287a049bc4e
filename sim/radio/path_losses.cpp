#include "sim/radio/path_losses.h"

#include "sim/radio/distance_laws.h"
#include "sim/radio/fading.h"
#include "sim/radio/power_law.h"
#include "sim/radio/shadowing.h"

namespace sim::radio {
namespace {

using Made = std::unique_ptr<const PathLoss>;

Made made(const ForeignLawConfig& config, const PropagationConfig& air) { return config.make(air); }

Made made(const PowerLawConfig&, const PropagationConfig& air) {
  return std::make_unique<PowerLaw>(air.wavelength, air.path_loss_exponent);
}

Made made(const FriisConfig&, const PropagationConfig& air) {
  return std::make_unique<PowerLaw>(air.wavelength, 2);
}

Made made(const LogDistanceConfig& config, const PropagationConfig&) {
  return std::make_unique<LogDistance>(config);
}

Made made(const TwoRayGroundConfig&, const PropagationConfig& air, const Ground& ground) {
  return std::make_unique<TwoRayGround>(air.wavelength, ground);
}

Made made(const ShadowingConfig& config, const PropagationConfig&) {
  return std::make_unique<Shadowing>(config);
}

Made made(const NakagamiConfig& config, const PropagationConfig& air) {
  return std::make_unique<NakagamiFading>(config, air.wavelength);
}

Made made(const RicianConfig& config, const PropagationConfig& air) {
  return std::make_unique<RicianFading>(config, air.wavelength);
}

Made made(const RayleighConfig& config, const PropagationConfig& air) {
  return std::make_unique<RayleighFading>(config, air.wavelength);
}

}  // namespace

std::unique_ptr<const PathLoss> path_loss(const PathLossConfig& config,
                                          const PropagationConfig& air, const Ground& ground) {
  return std::visit(
      [&](const auto& one) {
        if constexpr (requires { made(one, air, ground); })
          return made(one, air, ground);
        else
          return made(one, air);
      },
      config);
}

}  // namespace sim::radio
