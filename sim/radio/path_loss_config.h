#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>

#include "hal/types/quantity.h"

namespace sim::radio {

class PathLoss;
struct PropagationConfig;

/// Kind of an entry in a propagation chain. Each model has its kind in `kKind` and its name in
/// files in `kModel`.
enum class PathLossKind : std::uint8_t {
  kLawOfDistance,  ///< Power decreases with distance without limit. A chain has exactly one.
  kOfLinks,        ///< Constant for a link whose ends do not move; differs between links.
  kFading,         ///< Each link fades in time. A chain has at most one.
};

/// Free space (Friis): the power law with exponent 2.
struct FriisConfig {
  static constexpr std::string_view kModel = "friis";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

/// Pt lambda^2 / (16 pi^2 d^alpha), alpha = PropagationConfig::path_loss_exponent.
struct PowerLawConfig {
  static constexpr std::string_view kModel = "power_law";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

/// L0 + 10 n log10(d / d0) dB; L0 up to the reference distance.
struct LogDistanceConfig {
  static constexpr std::string_view kModel = "log_distance";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
  hal::Decibels reference_loss{46.6777};  ///< L0; the default is Friis' at 1 m and 5.15 GHz. >= 0
  hal::Metres reference_distance{1};      ///< d0 > 0
  double exponent = 3;                    ///< n >= 1
};

/// Friis up to the crossover distance, the fourth power of the distance beyond.
struct TwoRayGroundConfig {
  static constexpr std::string_view kModel = "two_ray_ground";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

/// Log-normal shadowing: a value of each link for each position of its ends.
struct ShadowingConfig {
  static constexpr std::string_view kModel = "shadowing";
  static constexpr PathLossKind kKind = PathLossKind::kOfLinks;
  hal::Decibels sigma{4};                  ///< >= 0; values are cut at three times that.
  hal::Metres decorrelation_distance{20};  ///< > 0; correlation 1/e when one end moved this far.
};

/// Common part of all models of fading in time.
struct FadingConfig {
  static constexpr PathLossKind kKind = PathLossKind::kFading;
  /// Speed of the scatterers, m/s, >= 0. With 0 fading depends only on the positions of the ends.
  double scatterer_speed = 0;
};

struct RayleighConfig : FadingConfig {
  static constexpr std::string_view kModel = "rayleigh";
};

struct RicianConfig : FadingConfig {
  static constexpr std::string_view kModel = "rician";
  hal::Decibels k{6};  ///< K factor: power of the direct path over that of all others.
};

/// The shape m depends on distance; the defaults are ns-3's.
struct NakagamiConfig : FadingConfig {
  static constexpr std::string_view kModel = "nakagami";
  double m_near = 1.5, m_middle = 0.75, m_far = 0.75;  ///< 0.5 .. 50
  hal::Metres middle_from{80}, far_from{200};          ///< 0 <= middle_from <= far_from
};

/// A law of a program that links the simulator, or of a test. Files cannot name it; records and
/// messages do.
struct ForeignLawConfig {
  std::string_view model;  ///< Its name; outlives the config, as a literal does.
  PathLossKind kind = PathLossKind::kLawOfDistance;
  /// Never null. @param air  as path_loss() gets it.
  std::unique_ptr<const PathLoss> (*make)(const PropagationConfig& air) = nullptr;
};

/// One entry of a chain of propagation. Files can name all but the last.
using PathLossConfig =
    std::variant<PowerLawConfig, FriisConfig, LogDistanceConfig, TwoRayGroundConfig,
                 ShadowingConfig, NakagamiConfig, RicianConfig, RayleighConfig, ForeignLawConfig>;

inline PathLossKind kind_of(const PathLossConfig& config) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.kind; })
          return one.kind;
        else
          return one.kKind;
      },
      config);
}

/// Its name, as in files.
inline std::string_view model_of(const PathLossConfig& config) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.model; })
          return one.model;
        else
          return one.kModel;
      },
      config);
}

inline bool is_law_of_distance(const PathLossConfig& config) {
  return kind_of(config) == PathLossKind::kLawOfDistance;
}
inline bool is_fading(const PathLossConfig& config) {
  return kind_of(config) == PathLossKind::kFading;
}

}  // namespace sim::radio
