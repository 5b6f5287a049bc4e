#pragma once

#include <cstdint>

#include "hal/types/quantity.h"

namespace sim::radio {

inline constexpr std::uint32_t kChannels = 14;  ///< Channels of the 2.4 GHz band, numbered from 1.

/// Centre frequency of a channel of the 2.4 GHz band (IEEE Std 802.11-2016, table 16-6): 2407 MHz +
/// 5 MHz * number for channels 1 .. 13, 2484 MHz for channel 14. @pre channel is 1 .. 14.
constexpr hal::Hertz centre_frequency(std::uint32_t channel) {
  return hal::Hertz{channel == kChannels ? 2484e6 : 2407e6 + 5e6 * channel};
}

/// Wavelength on a channel, computed from the wavelength `known` on channel `of`.
constexpr hal::Metres wavelength_on(std::uint32_t channel, hal::Metres known, std::uint32_t of) {
  if (channel == of) return known;
  return (centre_frequency(of).value / centre_frequency(channel).value) * known;
}

}  // namespace sim::radio
