#pragma once

#include "hal/types/quantity.h"

namespace sim {

/// Attenuation of a radio wave that passes through an obstacle.
struct ObstacleLoss {
  hal::Decibels per_crossing{};  ///< >= 0
  double per_metre = 0;          ///< dB per metre of the path inside, >= 0

  constexpr bool operator==(const ObstacleLoss&) const = default;
  constexpr bool is_none() const { return per_crossing.value == 0 && per_metre == 0; }
};

/// Loss of the walls of buildings: C. Sommer, D. Eckhoff, R. German, F. Dressler, "A
/// Computationally Inexpensive Empirical Model of IEEE 802.11p Radio Shadowing in Urban
/// Environments", WONS 2011, table II.
inline constexpr ObstacleLoss kBrickWall{hal::Decibels{9.0}, 0.4};

}  // namespace sim
