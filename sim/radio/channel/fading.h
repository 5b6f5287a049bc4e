#pragma once

#include "sim/radio/channel/path_loss.h"

namespace sim::radio {

/// Common part of all models of fading in time.
struct FadingConfig {
  static constexpr PathLossKind kKind = PathLossKind::kFading;
  /// Speed of the scatterers, m/s, >= 0. With 0 fading depends only on the positions of the ends.
  double scatterer_speed = 0;
};

/// The keys that all models of fading share.
template <class Fields>
void keys_of(Fields& io, FadingConfig& c) {
  io.number({"scatterer_speed",
             "Speed of the objects that reflect the waves, added to that of the nodes. 0 m/s: a "
             "link changes only when one of its ends moves.",
             "1 m/s"},
            "m/s", {0, 1000}, c.scatterer_speed);
}

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
    double power() const { return in_phase * in_phase + quadrature * quadrature; }
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

}  // namespace sim::radio
