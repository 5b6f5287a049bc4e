#pragma once

#include "sim/radio/channel/path_loss.h"
#include "sim/radio/channel/power_law.h"

namespace sim::radio {

/// Direct and reflected ray added with their phases.
struct TwoRayInterferenceConfig {
  static constexpr std::string_view kModel = "two_ray_interference";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
  double reflection = -1;  ///< Coefficient of the ground, -1 .. 1: of the amplitude, with its sign.
};

template <class Fields>
void keys_of(Fields& io, TwoRayInterferenceConfig& c) {
  io.number({"reflection",
             "Reflection coefficient of the ground, of the amplitude: -1, a perfect reflector at "
             "grazing incidence; 0, no reflected ray.",
             "-0.6"},
            "1", {-1, 1}, c.reflection);
}

std::unique_ptr<const PathLoss> make(const TwoRayInterferenceConfig& config,
                                     const PropagationConfig& air, const Ground& ground);

/// The fields of a ray from antenna to antenna, of length d1, and of one reflected by the ground,
/// of length d2, added with their phases: P = Pt (lambda / 4 pi)^2 |1 / d1 + R exp(-j 2 pi (d2 -
/// d1) / lambda) / d2|^2, at most Pt (T. S. Rappaport, "Wireless Communications", 2nd ed., 4.6,
/// before the approximation for large distances). d2^2 = d1^2 + 4 ht hr, exact on a plane, with the
/// heights of the antennas above the ground where each stands; one below the ground counts as on
/// it. R is the same for all angles. Where an
/// antenna is not equal in all directions, the reflected ray has its gain towards the other one's
/// image below the ground. Far away P falls with the fourth power if R = -1, else with
/// the second.
class TwoRayInterference final : public PathLoss {
 public:
  /// @param reflection  R, -1 .. 1. @param ground  outlives this.
  TwoRayInterference(hal::Metres wavelength, double reflection, const Ground& ground)
      : free_space_(wavelength, 2),
        wavelength_(wavelength.value),
        reflection_(reflection),
        ground_(ground) {}

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  /// Where both rays are in phase everywhere, (1 + |R|)^2 times as strong: an upper bound.
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;

 private:
  double height(const Site& site) const;

  PowerLaw free_space_;
  double wavelength_;  ///< m
  double reflection_;
  const Ground& ground_;
};

}  // namespace sim::radio
