#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/quantity.h"

namespace sim::radio {

enum class Standard : std::uint8_t { kIeee80211b, kIeee80211g };

/// Settings of one station's radio; unset ones are taken from the network's RadioConfig.
struct StationConfig {
  std::optional<hal::Milliwatts> tx_power{};    ///< Power into the antenna, > 0.
  std::optional<hal::Metres> antenna_height{};  ///< Above the station's position, >= 0.
  std::optional<hal::Decibels> antenna_gain{};  ///< Equal in all directions.
  std::optional<std::uint32_t> channel{};       ///< 1 .. 14.
  /// In a network of ieee80211g: kIeee80211b for a station without OFDM.
  std::optional<Standard> standard{};
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
