#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/radio/channel/path_loss.h"

namespace sim::radio {

/// Multi-wall law. With k_m crossed walls of material m and k crossed ceilings, in dB:
///
///   L = 20 log10(4 pi d0 / lambda) + 10 n log10(d / d0) + L_c
///       + sum k_m L_m + k^((k + 2) / (k + 1) - b) L_f,   d0 = 1 m
///
/// A. J. Motley, J. M. P. Keenan, "Personal communication radio coverage in buildings at 900 MHz
/// and 1700 MHz", Electronics Letters 24 (12), 1988; term of the ceilings and L_c: COST Action 231,
/// final report, 1999, section 4.7, where n = 2. L_f is the mean of the crossed ceilings' losses.
///
/// This is the law of distance of a chain; the walls and ceilings are a loss by obstacles
/// (WallLosses), so that frames lost to them are recorded as stopped by walls.
struct MultiWallConfig {
  static constexpr std::string_view kModel = "multi_wall";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;

  struct WallLoss {
    std::string material;
    hal::Decibels loss{};  ///< L_m, >= 0
  };
  hal::Decibels constant_loss{};                ///< L_c
  double exponent = 2;                          ///< n > 0
  std::vector<WallLoss> walls{};                ///< Replace the losses of these materials.
  std::optional<hal::Decibels> ceiling_loss{};  ///< L_f, for all; nullopt: those of the ceilings.
  double ceiling_b = 0.46;                      ///< b
  /// Parts of walls of one material that are no farther apart than this, along the path, are one
  /// wall. > 0
  hal::Metres gap{1e-3};
};

template <class Fields>
void keys_of(Fields& io, MultiWallConfig::WallLoss& c) {
  io.needed_text({"material", "A material of the world's walls.", "brick"}, c.material);
  io.needed({"loss", "Loss of one crossing.", "5 dB"}, "dB", {0, 1000}, c.loss.value);
}

template <class Fields>
void keys_of(Fields& io, MultiWallConfig& c) {
  io.quantity({"constant_loss",
               "Loss besides free space up to 1 m, the distance, walls and ceilings.", "2 dB"},
              "dB", {-100, 300}, c.constant_loss);
  io.number({"exponent",
             "Path loss exponent from 1 m on, without walls and ceilings. 2: free space.", "2"},
            "1", {0.1, 8}, c.exponent);
  io.template list_if_any<MultiWallConfig::WallLoss>(
      {"walls", "Losses that replace those of the materials, such as `baraka coverage` fits them.",
       "[{material: brick, loss: 5 dB}]"},
      c.walls, [](auto& one, MultiWallConfig::WallLoss& wall) { keys_of(one, wall); });
  io.given({"ceiling_loss",
            "Loss of one ceiling. Default: that of each of the world's `ceilings`; of those that a "
            "path crosses, the mean.",
            "18.3 dB"},
           "dB", {0, 1000}, c.ceiling_loss);
  io.number({"ceiling_b",
             "Parameter b of COST 231: k crossed ceilings count k^((k + 2) / (k + 1) - b) times.",
             "0.46"},
            "1", {0, 2}, c.ceiling_b);
  io.quantity({"gap",
               "Parts of walls of one material that touch, overlap or are no farther apart than "
               "this, along the path, are crossed as one wall.",
               "1 mm"},
              "m", {1e-6, 10}, c.gap);
}

std::unique_ptr<const PathLoss> make(const MultiWallConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

/// Its law of distance. Never leaves more than was sent.
class MultiWall final : public PathLoss {
 public:
  /// @param wavelength  > 0
  MultiWall(const MultiWallConfig& config, hal::Metres wavelength);

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;
  bool falls_with_distance() const override { return true; }

 private:
  double at_reference_;  ///< Share that is left at 1 m, by the formula.
  double exponent_;
};

}  // namespace sim::radio
