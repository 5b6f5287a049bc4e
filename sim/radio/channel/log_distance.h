#pragma once

#include "sim/radio/channel/path_loss.h"

namespace sim::radio {

/// L0 + 10 n log10(d / d0) dB; L0 up to the reference distance.
struct LogDistanceConfig {
  static constexpr std::string_view kModel = "log_distance";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
  hal::Decibels reference_loss{46.6777};  ///< L0; the default is Friis' at 1 m and 5.15 GHz. >= 0
  hal::Metres reference_distance{1};      ///< d0 > 0
  double exponent = 3;                    ///< n >= 1
};

template <class Fields>
void keys_of(Fields& io, LogDistanceConfig& c) {
  io.quantity({"reference_loss", "Path loss at the reference distance.", "46.6777 dB"}, "dB",
              {0, 300}, c.reference_loss);
  io.quantity({"reference_distance", "Distance beyond which the loss grows.", "1 m"}, "m",
              {1e-3, 1e6}, c.reference_distance);
  io.number(
      {"exponent",
       "Path loss exponent: the loss grows by ten times this, in dB, for ten times the distance.",
       "3"},
      "1", {1, 8}, c.exponent);
}

std::unique_ptr<const PathLoss> make(const LogDistanceConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

/// L0 + 10 n log10(d / d0) dB, and L0 where d < d0 (T. S. Rappaport, "Wireless Communications",
/// 2nd ed., 4.9.1).
class LogDistance final : public PathLoss {
 public:
  explicit LogDistance(const LogDistanceConfig& config);

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;
  bool falls_with_distance() const override { return true; }

 private:
  double at_reference_;  ///< Share of the power that is left at the reference distance.
  double reference_;     ///< m
  double exponent_;
};

}  // namespace sim::radio
