#pragma once

#include "sim/core/ground.h"
#include "sim/radio/path_loss.h"
#include "sim/radio/path_loss_config.h"
#include "sim/radio/power_law.h"

namespace sim::radio {

/// L0 + 10 n log10(d / d0) dB, and L0 where d < d0 (T. S. Rappaport, "Wireless Communications",
/// 2nd ed., 4.9.1).
class LogDistance final : public PathLoss {
 public:
  explicit LogDistance(const LogDistanceConfig& config);

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;

 private:
  double at_reference_;  ///< Share of the power that is left at the reference distance.
  double reference_;     ///< m
  double exponent_;
};

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
