#pragma once

#include <cstdint>

#include "hal/types/quantity.h"

namespace sim::radio {

inline constexpr std::uint32_t kChannels = 14;  ///< Channels of the 2.4 GHz band, numbered from 1.
inline constexpr std::uint32_t kLastChannel = 165;  ///< Of the 5 GHz band.

constexpr bool is_5ghz(std::uint32_t channel) { return channel > kChannels; }

/// Whether there is a 20 MHz channel of this number: 1 .. 14, 36 .. 64, 100 .. 144 and 149 .. 165,
/// those in 5 GHz in steps of 4 (IEEE Std 802.11-2020, annex E).
constexpr bool is_channel(std::uint32_t channel) {
  if (!is_5ghz(channel)) return channel >= 1;
  if (channel >= 149) return channel <= kLastChannel && channel % 4 == 1;
  const bool is_in_range = (channel >= 36 && channel <= 64) || (channel >= 100 && channel <= 144);
  return is_in_range && channel % 4 == 0;
}

/// Whether the 20 MHz channel can be the primary one of a channel of this width, MHz.
constexpr bool has_width(std::uint32_t channel, std::uint32_t width) {
  if (width == 20) return true;
  if (!is_5ghz(channel)) return width == 40 && channel < kChannels;
  return (width == 40 || width == 80) && channel != kLastChannel;
}

/// Centre frequency of a 20 MHz channel (IEEE Std 802.11-2016, table 16-6 and 17.3.8.4.2): 2407 MHz
/// + 5 MHz * number for channels 1 .. 13, 2484 MHz for channel 14, 5000 MHz + 5 MHz * number in
/// 5 GHz. @pre is_channel(channel).
constexpr hal::Hertz centre_frequency(std::uint32_t channel) {
  if (is_5ghz(channel)) return hal::Hertz{5000e6 + 5e6 * channel};
  return hal::Hertz{channel == kChannels ? 2484e6 : 2407e6 + 5e6 * channel};
}

/// Wavelength on a channel, computed from the wavelength `known` on channel `of`.
constexpr hal::Metres wavelength_on(std::uint32_t channel, hal::Metres known, std::uint32_t of) {
  if (channel == of) return known;
  return (centre_frequency(of).value / centre_frequency(channel).value) * known;
}

}  // namespace sim::radio
