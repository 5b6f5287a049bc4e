#pragma once

#include <array>

#include "sim/radio/channel/fading.h"
#include "sim/radio/channel/gamma_quantile.h"

namespace sim::radio {

/// Fading whose shape m depends on distance; the defaults are ns-3's.
struct NakagamiConfig : FadingConfig {
  static constexpr std::string_view kModel = "nakagami";
  double m_near = 1.5, m_middle = 0.75, m_far = 0.75;  ///< 0.5 .. 50
  hal::Metres middle_from{80}, far_from{200};          ///< 0 <= middle_from <= far_from
};

template <class Fields>
void keys_of(Fields& io, NakagamiConfig& c) {
  io.number({"m_near",
             "Shape parameter m at distances below `middle_from`; 1: Rayleigh fading, larger: "
             "weaker fading.",
             "1.5"},
            "1", {0.5, 50}, c.m_near);
  io.number(
      {"m_middle", "Shape parameter m at distances from `middle_from` to `far_from`.", "0.75"}, "1",
      {0.5, 50}, c.m_middle);
  io.number({"m_far", "Shape parameter m at distances beyond `far_from`.", "0.75"}, "1", {0.5, 50},
            c.m_far);
  io.quantity({"middle_from", "Distance from which `m_middle` applies.", "80 m"}, "m", {0, 1e6},
              c.middle_from);
  io.quantity({"far_from", "Distance from which `m_far` applies.", "200 m"}, "m", {0, 1e6},
              c.far_from);
  if (c.far_from < c.middle_from) io.mistake("far_from", "is below middle_from");
  keys_of(io, static_cast<FadingConfig&>(c));
}

std::unique_ptr<const PathLoss> make(const NakagamiConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

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
