#pragma once

#include <optional>

#include "sim/radio/phy/capabilities.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/phy/reception.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Derives the config of stations with these settings from that of the network.
///
/// A station of ieee80211b in a network of ieee80211g uses the values of profile ieee80211b
/// wherever the network has the defaults of ieee80211g: rates, windows, thresholds. One of another
/// older standard has the network's values, as far as its standard has them. In a mixed cell
/// all stations use the slot of 20 us (IEEE Std 802.11-2016, 18.4.4), and group frames and basic
/// rates use modes that every station supports.
/// @param network,own  checked.  @param is_mixed  Cell::is_mixed() of its channel number.
RadioConfig config_for(const RadioConfig& network, const StationConfig& own, bool is_mixed);

/// What a station with this config supports; everything in profiles without rates.
Capabilities capabilities_of(const RadioConfig& config);

/// Parameters shared by stations with equal settings.
struct StationProfile {
  explicit StationProfile(const RadioConfig& the_config);

  RadioConfig config;
  ModeSet modes;
  std::optional<ReceptionRules> rules;  ///< For profiles with a medium.
};

}  // namespace sim::radio
