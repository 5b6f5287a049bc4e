#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>

#include "hal/types/quantity.h"

namespace sim::radio {

class PathLoss;
struct PropagationConfig;

/// What an entry of a chain of propagation is. Each kind of entry says so itself, in `kKind`, and
/// its name in files in `kModel`.
enum class PathLossKind : std::uint8_t {
  kLawOfDistance,  ///< Makes power fall with distance, without end. A chain has one.
  kOfLinks,        ///< Differs from link to link, and lasts.
  kFading,         ///< Makes each link fade in time. A chain has one at most.
};

/// Free space: a power law with the exponent 2.
struct FriisConfig {
  static constexpr std::string_view kModel = "friis";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

/// With the exponent of the radio.
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

/// Friis' up to the crossover distance, with the fourth power of the distance beyond.
struct TwoRayGroundConfig {
  static constexpr std::string_view kModel = "two_ray_ground";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

/// Log-normal, a value of each link for each place of its ends.
struct ShadowingConfig {
  static constexpr std::string_view kModel = "shadowing";
  static constexpr PathLossKind kKind = PathLossKind::kOfLinks;
  hal::Decibels sigma{4};                  ///< >= 0; values are cut at three times that.
  hal::Metres decorrelation_distance{20};  ///< > 0: an end that moves so far keeps 1/e.
};

/// Of all kinds of fading in time: what scatters the waves moves with this speed, m/s, >= 0. With 0
/// the fading of a link changes only with its ends' places.
struct FadingConfig {
  static constexpr PathLossKind kKind = PathLossKind::kFading;
  double scatterer_speed = 0;
};

struct RayleighConfig : FadingConfig {
  static constexpr std::string_view kModel = "rayleigh";
};

struct RicianConfig : FadingConfig {
  static constexpr std::string_view kModel = "rician";
  hal::Decibels k{6};  ///< Power of the direct ray over that of all others.
};

/// m by distance; the defaults are ns-3's.
struct NakagamiConfig : FadingConfig {
  static constexpr std::string_view kModel = "nakagami";
  double m_near = 1.5, m_middle = 0.75, m_far = 0.75;  ///< 0.5 .. 50
  hal::Metres middle_from{80}, far_from{200};          ///< 0 <= middle_from <= far_from
};

/// A law from outside the simulator: of a program that links it, or of a test. Files cannot name
/// it; records and messages do.
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
