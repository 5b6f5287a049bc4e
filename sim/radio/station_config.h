#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/quantity.h"
#include "sim/radio/channel/antenna.h"
#include "sim/radio/standard.h"

namespace sim::radio {

/// Settings of one station's radio; unset ones are taken from the network's RadioConfig.
struct StationConfig {
  std::optional<hal::Milliwatts> tx_power{};    ///< Power into the antenna, > 0.
  std::optional<hal::Metres> antenna_height{};  ///< Above the station's position, >= 0.
  std::optional<hal::Decibels> antenna_gain{};  ///< In all directions, or times that of `antenna`.
  std::optional<AntennaConfig> antenna{};       ///< Gain by direction.
  /// In the band of the network.
  std::optional<std::uint32_t> channel{};
  /// In a network of ieee80211g or newer: that or an older one that exists in the band.
  std::optional<Standard> standard{};
  /// Of a station with MCSs: as in McsConfig, and what it supports at most.
  std::optional<std::uint8_t> mcs{}, streams{};
  std::optional<std::uint16_t> width{};  ///< MHz
  std::optional<hal::BitsPerSecond> data_rate{};
  std::optional<hal::BitsPerSecond> control_rate{};
  std::optional<hal::BitsPerSecond> broadcast_rate{};
  /// Names of the access points that the station may use. Empty: none; the station is in an ad hoc
  /// network. Not set: those of the network (BssConfig). Any station named in such a list is an
  /// access point.
  std::optional<std::vector<std::string>> access_points{};

  bool operator==(const StationConfig&) const = default;
};

}  // namespace sim::radio
