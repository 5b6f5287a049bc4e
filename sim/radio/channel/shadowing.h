#pragma once

#include "sim/radio/channel/path_loss.h"

namespace sim::radio {

/// Log-normal shadowing: a value of each link for each position of its ends.
struct ShadowingConfig {
  static constexpr std::string_view kModel = "shadowing";
  static constexpr PathLossKind kKind = PathLossKind::kOfLinks;
  hal::Decibels sigma{4};                  ///< >= 0; values are cut at three times that.
  hal::Metres decorrelation_distance{20};  ///< > 0; correlation 1/e when one end moved this far.
};

template <class Fields>
void keys_of(Fields& io, ShadowingConfig& c) {
  io.quantity(
      {"sigma", "Standard deviation among links; no link deviates by more than three times this.",
       "4 dB"},
      "dB", {0, 30}, c.sigma);
  io.quantity({"decorrelation_distance",
               "Distance that one end of a link must move for the correlation to fall to 1/e; the "
               "decay is exponential.",
               "20 m"},
              "m", {1e-3, 1e6}, c.decorrelation_distance);
}

std::unique_ptr<const PathLoss> make(const ShadowingConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

/// Log-normal shadowing, frozen for each link as long as its ends stay: X dB, normal with mean 0
/// and standard deviation sigma, cut at 3 sigma. Where one end goes from p to p' the correlation
/// is exp(-|p' - p| / d) (M. Gudmundson, "Correlation model for shadow fading in mobile radio
/// systems", Electronics Letters 27(23), 1991); where both move it is the product of the two
/// (Z. Wang, E. K. Tameh, A. R. Nix, "Joint shadowing process in urban peer-to-peer radio
/// channels", IEEE Trans. Veh. Technol. 57(1), 2008). The same in both directions.
///
/// X is a function of the two places, not of the way there: a sum of cosines over both, their wave
/// vectors drawn from the spectrum of the exponential in the plane, 1 / (1 + k^2 d^2)^(3/2), from
/// the stream of the link.
class Shadowing final : public PathLoss {
 public:
  explicit Shadowing(const ShadowingConfig& config)
      : sigma_(config.sigma.value), distance_(config.decorrelation_distance.value) {}

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;
  double most_gain() const override;

 private:
  double sigma_;     ///< dB
  double distance_;  ///< m
};

}  // namespace sim::radio
