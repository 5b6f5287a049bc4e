#pragma once

#include <optional>

#include "sim/radio/mode_set.h"
#include "sim/radio/radio_config.h"
#include "sim/radio/reception.h"

namespace sim::radio {

/// The network's config as it is for stations with these settings.
///
/// A station of ieee80211b in a network of ieee80211g has the values of that profile wherever the
/// network has those of ieee80211g: rates, windows, thresholds. In a mixed cell everybody has the
/// slot of 20 us (IEEE Std 802.11-2016, 18.4.4), and group frames and basic rates are such as all
/// know.
/// @param network, own  checked.  @param is_mixed  Cell::is_mixed() of its channel number.
RadioConfig config_for(const RadioConfig& network, const StationConfig& own, bool is_mixed);

/// It can receive OFDM, and sends it.
bool knows_ofdm(const RadioConfig& network, const StationConfig& own);

/// What stations with equal settings have in common.
struct StationProfile {
  explicit StationProfile(const RadioConfig& the_config);

  RadioConfig config;
  ModeSet modes;
  std::optional<ReceptionRules> rules;  ///< Of profiles with waves.
};

}  // namespace sim::radio
