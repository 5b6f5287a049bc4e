#pragma once

#include <array>

#include "sim/radio/gamma_quantile.h"
#include "sim/radio/path_loss.h"
#include "sim/radio/path_loss_config.h"

namespace sim::radio {

/// Fading by scatterers all around (R. H. Clarke, "A statistical theory of mobile-radio reception",
/// BSTJ 47, 1968; W. C. Jakes, "Microwave Mobile Communications", 1974): the sum of plane waves of
/// equal power from random directions with random phases. The autocorrelation of a link whose ends
/// move with the relative speed v is J0(2 pi v t / lambda). If scatterers move, the phases of the
/// waves change with time as if one end moved with their speed.
///
/// The field is a function of the positions of the ends and of time, drawn from the stream of the
/// link: it does not depend on how often or when it is evaluated.
class Fading : public PathLoss {
 public:
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;
  bool changes_in_time() const override { return speed_ > 0; }

 protected:
  Fading(const FadingConfig& config, hal::Metres wavelength)
      : wavelength_(wavelength.value), speed_(config.scatterer_speed) {}

  struct Wave {
    double in_phase, quadrature;
  };
  /// Mean power 1.
  Wave scattered(const Path& path) const;
  /// Mean power 1 and a power that does not change.
  Wave direct(const Path& path) const;

  static constexpr int kWaves = 32;  ///< They may all add up: kWaves times the mean power.

 private:
  double wavelength_;  ///< m
  double speed_;       ///< m/s
};

/// No direct ray: power exponential.
class RayleighFading final : public Fading {
 public:
  RayleighFading(const RayleighConfig& config, hal::Metres wavelength)
      : Fading(config, wavelength) {}
  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double most_gain() const override { return kWaves; }
};

/// A direct ray with K times the power of all others (S. O. Rice, "Statistical properties of a sine
/// wave plus random noise", BSTJ 27, 1948).
class RicianFading final : public Fading {
 public:
  RicianFading(const RicianConfig& config, hal::Metres wavelength);
  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double most_gain() const override;

 private:
  double direct_, scattered_;  ///< Amplitudes.
};

/// Power with a gamma distribution of shape m and the mean 1 (M. Nakagami, "The m-distribution",
/// 1960), m by distance: the gamma quantile of the Rayleigh power's rank, so that it crosses a
/// level when Rayleigh fading crosses that of equal rank.
class NakagamiFading final : public Fading {
 public:
  NakagamiFading(const NakagamiConfig& config, hal::Metres wavelength);
  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double most_gain() const override;

 private:
  std::array<GammaQuantile, 3> by_distance_;
  double middle_from_, far_from_;  ///< m^2
};

}  // namespace sim::radio
