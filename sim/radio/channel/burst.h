#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Energy that is not a frame, radiated at a position without a station.
struct Burst {
  hal::Vec3 from;                        ///< Position of the antenna [m], world frame.
  hal::Milliwatts power;                 ///< Radiated power, equal in all directions.
  std::optional<std::uint32_t> channel;  ///< Channel number; nullopt: that of the network's config.
  hal::Duration length{};                ///< > 0 and <= kLongestBurst.
};
inline constexpr hal::Duration kLongestBurst = std::chrono::seconds{4};

}  // namespace sim::radio
