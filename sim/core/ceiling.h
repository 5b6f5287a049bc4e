#pragma once

#include "hal/types/quantity.h"

namespace sim {

/// Loss of a floor between two storeys at 1.8 GHz: COST Action 231, final report, 1999,
/// section 4.7.
inline constexpr hal::Decibels kCeilingLoss{18.3};

/// A ceiling that spans the whole world, for radio waves only; it stops no body.
struct Ceiling {
  hal::Metres height{};              ///< World frame.
  hal::Decibels loss{kCeilingLoss};  ///< Of crossing this one alone, >= 0.

  bool operator==(const Ceiling&) const = default;
};

}  // namespace sim
