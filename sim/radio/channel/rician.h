#pragma once

#include "sim/radio/channel/fading.h"

namespace sim::radio {

/// Fading with a direct path.
struct RicianConfig : FadingConfig {
  static constexpr std::string_view kModel = "rician";
  hal::Decibels k{6};  ///< K factor: power of the direct path over that of all others.
};

template <class Fields>
void keys_of(Fields& io, RicianConfig& c) {
  io.quantity(
      {"k", "K factor: ratio of the power of the direct ray to that of all others.", "6 dB"}, "dB",
      {-50, 50}, c.k);
  keys_of(io, static_cast<FadingConfig&>(c));
}

std::unique_ptr<const PathLoss> make(const RicianConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

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

}  // namespace sim::radio
