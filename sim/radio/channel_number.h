#pragma once

#include <cstdint>

#include "hal/types/quantity.h"

namespace sim::radio {

inline constexpr std::uint32_t kChannels = 14;  ///< In 2.4 GHz, from 1 on.

/// In the middle of a channel of 2.4 GHz (IEEE Std 802.11-2016, table 16-6): 2407 MHz and 5 MHz for
/// each number; the last one lies apart. @pre 1 .. 14.
constexpr hal::Hertz centre_frequency(std::uint32_t channel) {
  return hal::Hertz{channel == kChannels ? 2484e6 : 2407e6 + 5e6 * channel};
}

/// The wavelength of another channel.
constexpr hal::Metres wavelength_on(std::uint32_t channel, hal::Metres known, std::uint32_t of) {
  if (channel == of) return known;
  return (centre_frequency(of).value / centre_frequency(channel).value) * known;
}

}  // namespace sim::radio
