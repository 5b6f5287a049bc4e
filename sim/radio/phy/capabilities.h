#pragma once

#include <algorithm>
#include <cstdint>

#include "sim/radio/phy/mode_id.h"

namespace sim::radio {

/// What a station can send and receive. A default one can everything, which is what is assumed of
/// an address without a station.
struct Capabilities {
  static constexpr hal::Duration kShortGuard{400};

  std::uint8_t classes = 0xff;  ///< A set: bit number n for the class of that value.
  std::uint8_t streams = 4;     ///< Most spatial streams.
  std::uint16_t width = 160;    ///< Greatest width, MHz.
  bool short_guard = true;      ///< The guard interval of 0.4 us, in HT and VHT.
  bool operator==(const Capabilities&) const = default;

  static constexpr std::uint8_t bit(ModulationClass modulation) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(modulation));
  }
  constexpr bool supports(ModulationClass modulation) const {
    return (classes & bit(modulation)) != 0;
  }
  /// Whether the station can receive the preamble and the first part of the header: of HT and what
  /// came after it they are those of OFDM (the mixed format).
  constexpr bool hears(const ModeId& mode) const {
    return supports(mode.modulation) ||
           (has_streams(mode.modulation) && supports(ModulationClass::kOfdm));
  }
  constexpr bool supports(const ModeId& mode) const {
    if (!supports(mode.modulation)) return false;
    return mode.streams <= streams && mode.width <= width &&
           (short_guard || mode.guard != kShortGuard);
  }
};

/// Best mode for a station of these capabilities, of what the sender wants at most: the newest
/// class that both know, the same or the next smaller width and number of streams. @pre it has
/// MCSs. The MCS is left as it is and may be too high for the class.
constexpr ModeId nearest(ModeId wanted, const Capabilities& receiver) {
  while (wanted.modulation > ModulationClass::kNone && !receiver.supports(wanted.modulation)) {
    wanted.modulation = static_cast<ModulationClass>(static_cast<int>(wanted.modulation) - 1);
  }
  constexpr hal::Duration kLongGuard{800};
  constexpr std::uint16_t kWidestHt = 40;
  if (wanted.modulation == ModulationClass::kHt) wanted.width = std::min(wanted.width, kWidestHt);
  wanted.width = std::min(wanted.width, receiver.width);
  wanted.streams = std::min(wanted.streams, receiver.streams);
  const bool is_he = wanted.modulation == ModulationClass::kHe;
  const bool is_short = wanted.guard == Capabilities::kShortGuard && receiver.short_guard;
  if (!is_he && !is_short) wanted.guard = kLongGuard;
  return wanted;
}

}  // namespace sim::radio
