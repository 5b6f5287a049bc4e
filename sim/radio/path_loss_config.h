#pragma once

#include <variant>

#include "hal/types/quantity.h"

namespace sim::radio {

/// Free space: a power law with the exponent 2.
struct FriisConfig {};

/// With the exponent of the radio.
struct PowerLawConfig {};

/// L0 + 10 n log10(d / d0) dB; L0 up to the reference distance.
struct LogDistanceConfig {
  hal::Decibels reference_loss{46.6777};  ///< L0; the default is Friis' at 1 m and 5.15 GHz. >= 0
  hal::Metres reference_distance{1};      ///< d0 > 0
  double exponent = 3;                    ///< n >= 1
};

/// Friis' up to the crossover distance, with the fourth power of the distance beyond.
struct TwoRayGroundConfig {};

/// Log-normal, a value of each link for each place of its ends.
struct ShadowingConfig {
  hal::Decibels sigma{4};                  ///< >= 0; values are cut at three times that.
  hal::Metres decorrelation_distance{20};  ///< > 0: an end that moves so far keeps 1/e.
};

/// Of all kinds of fading in time: what scatters the waves moves with this speed, m/s, >= 0. With 0
/// the fading of a link changes only with its ends' places.
struct FadingConfig {
  double scatterer_speed = 0;
};

struct RayleighConfig : FadingConfig {};

struct RicianConfig : FadingConfig {
  hal::Decibels k{6};  ///< Power of the direct ray over that of all others.
};

/// m by distance; the defaults are ns-3's.
struct NakagamiConfig : FadingConfig {
  double m_near = 1.5, m_middle = 0.75, m_far = 0.75;  ///< 0.5 .. 50
  hal::Metres middle_from{80}, far_from{200};          ///< 0 <= middle_from <= far_from
};

/// One entry of a chain of propagation.
using PathLossConfig =
    std::variant<PowerLawConfig, FriisConfig, LogDistanceConfig, TwoRayGroundConfig,
                 ShadowingConfig, NakagamiConfig, RicianConfig, RayleighConfig>;

/// Whether it makes power fall with distance, without end.
inline bool is_law_of_distance(const PathLossConfig& config) { return config.index() <= 3; }

/// Whether it is one of those in which a link fades in time.
inline bool is_fading(const PathLossConfig& config) { return config.index() >= 5; }

}  // namespace sim::radio
