#pragma once

#include "sim/radio/channel/path_loss.h"
#include "sim/radio/channel/power_law.h"

namespace sim::radio {

/// Friis up to the crossover distance, the fourth power of the distance beyond.
struct TwoRayGroundConfig {
  static constexpr std::string_view kModel = "two_ray_ground";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

template <class Fields>
void keys_of(Fields& /*io*/, TwoRayGroundConfig& /*config*/) {}

std::unique_ptr<const PathLoss> make(const TwoRayGroundConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

/// A ray from antenna to antenna and one by way of the ground: Friis' law up to the crossover
/// distance 4 pi ht hr / lambda, P = Ptx ht^2 hr^2 / d^4 beyond, heights above the ground (T. S.
/// Rappaport, "Wireless Communications", 2nd ed., 4.6).
class TwoRayGround final : public PathLoss {
 public:
  /// @param ground  outlives this.
  TwoRayGround(hal::Metres wavelength, const Ground& ground)
      : free_space_(wavelength, 2), wavelength_(wavelength.value), ground_(ground) {}

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  /// The range in free space, an upper bound.
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override {
    return free_space_.reach(power, least);
  }

 private:
  double height(const Site& site) const;

  PowerLaw free_space_;
  double wavelength_;  ///< m
  const Ground& ground_;
};

}  // namespace sim::radio
