#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal/types/quantity.h"
#include "sim/radio/phy/mode_id.h"

namespace sim::radio {

/// What a station supports: amendments of IEEE Std 802.11, each with all before it that exist in
/// its band.
enum class Standard : std::uint8_t {
  kIeee80211b,   ///< DSSS and HR/DSSS, in 2.4 GHz.
  kIeee80211g,   ///< ERP; in 5 GHz OFDM alone, which is 802.11a.
  kIeee80211n,   ///< HT
  kIeee80211ac,  ///< VHT, in 5 GHz.
  kIeee80211ax,  ///< HE
};

/// The newest modulation class of a standard.
ModulationClass newest_class(Standard standard);

/// The rates of DSSS and HR/DSSS, and those of OFDM in 20 MHz, b/s (IEEE Std 802.11-2016, 16.1.2
/// and 17.1.1).
inline constexpr std::array kDsssRates{1e6, 2e6, 5.5e6, 11e6};
inline constexpr std::array kOfdmRates{6e6, 9e6, 12e6, 18e6, 24e6, 36e6, 48e6, 54e6};

/// The rates of a standard without MCSs as text for messages [Mb/s]; whether a rate is one of them.
std::string_view rates_of(Standard standard);
bool is_rate(Standard standard, hal::BitsPerSecond rate);
bool is_dsss_rate(hal::BitsPerSecond rate);

}  // namespace sim::radio
