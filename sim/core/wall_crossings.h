#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/quantity.h"

namespace sim {

/// What a straight path crosses.
struct WallCrossings {
  std::vector<std::uint32_t> walls;  ///< Number of walls, by material.
  std::uint32_t ceilings = 0;        ///< Number of ceilings.
  hal::Decibels ceiling_loss{};      ///< Sum of the losses of these ceilings, each alone.
};

}  // namespace sim
