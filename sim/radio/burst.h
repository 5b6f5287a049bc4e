#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Energy that is not a frame, from a position without a station.
struct Burst {
  hal::Vec3 from;                        ///< m, of its antenna, world frame
  hal::Milliwatts power;                 ///< Radiated, the same in all directions.
  std::optional<std::uint32_t> channel;  ///< None: that of the network's config.
  hal::Duration length{};                ///< > 0, at most kLongestBurst.
};
inline constexpr hal::Duration kLongestBurst = std::chrono::seconds{4};

}  // namespace sim::radio
