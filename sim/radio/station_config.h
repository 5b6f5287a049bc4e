#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/quantity.h"

namespace sim::radio {

enum class Standard : std::uint8_t { kIeee80211b, kIeee80211g };

/// Settings of one station's radio; unset ones are those of the network's RadioConfig.
struct StationConfig {
  std::optional<hal::Milliwatts> tx_power{};    ///< Into the antenna, > 0.
  std::optional<hal::Metres> antenna_height{};  ///< Above its position, >= 0.
  std::optional<hal::Decibels> antenna_gain{};  ///< The same in all directions.
  std::optional<std::uint32_t> channel{};       ///< 1 .. 14.
  std::optional<Standard> standard{};           ///< Of a network of ieee80211g: 11b, without OFDM.
  std::optional<hal::BitsPerSecond> data_rate{};
  std::optional<hal::BitsPerSecond> control_rate{};
  std::optional<hal::BitsPerSecond> broadcast_rate{};
  /// Names of the access points that it may use. Empty: none, it is in an ad hoc network. Not set:
  /// those of the network (BssConfig). A station that any list names is an access point.
  std::optional<std::vector<std::string>> access_points{};

  bool operator==(const StationConfig&) const = default;
};

}  // namespace sim::radio
