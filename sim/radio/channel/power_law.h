#pragma once

#include <cmath>

#include "hal/types/math.h"
#include "sim/radio/channel/path_loss.h"

namespace sim::radio {

/// Pt lambda^2 / (16 pi^2 d^alpha), alpha = PropagationConfig::path_loss_exponent.
struct PowerLawConfig {
  static constexpr std::string_view kModel = "power_law";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

template <class Fields>
void keys_of(Fields& /*io*/, PowerLawConfig& /*config*/) {}

std::unique_ptr<const PathLoss> make(const PowerLawConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

/// The root of `square` to an exponent >= 1; the exponents of almost every scenario need no pow().
inline double to_the(double exponent, double square) {
  if (exponent == 2) return square;
  if (exponent == 3) return square * std::sqrt(square);
  if (exponent == 4) return square * square;
  return hal::math::pow(square, exponent / 2);
}

/// Friis' law with an exponent: P = Ptx lambda^2 / (16 pi^2 d^alpha) with d in metres, never more
/// than Ptx (H. T. Friis, "A Note on a Simple Transmission Formula", Proc. IRE, 1946; exponent on
/// the distance only as in the Mobility Framework).
class PowerLaw final : public PathLoss {
 public:
  /// @param wavelength  m, > 0.  @param exponent  >= 1.
  PowerLaw(hal::Metres wavelength, double exponent)
      : wavelength_(wavelength.value), exponent_(exponent) {}

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;
  bool falls_with_distance() const override { return true; }

 private:
  double at_one_metre(double power) const;

  double wavelength_;  ///< m
  double exponent_;
};

/// All of the power up to a distance, and nothing beyond.
class Cutoff final : public PathLoss {
 public:
  explicit Cutoff(hal::Metres range) : range_(range.value) {}

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double reach(hal::Milliwatts, hal::Milliwatts) const override { return range_; }

 private:
  double range_;  ///< m, > 0
};

}  // namespace sim::radio
