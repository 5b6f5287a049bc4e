#pragma once

#include <compare>
#include <cstdint>

#include "hal/types/time.h"

namespace sim::radio {

/// Modulation classes (IEEE Std 802.11-2020, table 10-9, and IEEE Std 802.11ax-2021), the older
/// first. kDsss: DSSS and HR/DSSS; kOfdm: OFDM and ERP-OFDM.
enum class ModulationClass : std::uint8_t { kNone, kDsss, kOfdm, kHt, kVht, kHe };
inline constexpr std::size_t kModulationClasses = 6;

/// Whether a class has MCSs, streams, widths and guard intervals, and answers in another class.
constexpr bool has_streams(ModulationClass modulation) {
  return modulation >= ModulationClass::kHt;
}

/// What tells one PHY mode from all others; rates do not.
struct ModeId {
  ModulationClass modulation = ModulationClass::kNone;
  /// HT: 0 .. 7, whatever the number of streams; VHT: 0 .. 9; HE: 0 .. 11. DSSS and OFDM: place of
  /// the rate among those of the class, from 0.
  std::uint8_t mcs = 0;
  std::uint8_t streams = 1;  ///< Spatial streams, 1 .. 4.
  std::uint16_t width = 20;  ///< MHz; of DSSS, too, the 20 MHz for which noise is given.
  hal::Duration guard{};     ///< Guard interval; 0 in DSSS.
  auto operator<=>(const ModeId&) const = default;
};

}  // namespace sim::radio
