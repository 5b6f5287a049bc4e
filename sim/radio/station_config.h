#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/quantity.h"

namespace sim::radio {

enum class Standard : std::uint8_t { kIeee80211b, kIeee80211g };

/// What one station's radio has of its own; what is not set is as in the network's RadioConfig.
struct StationConfig {
  std::optional<hal::Milliwatts> tx_power{};    ///< Into the antenna, > 0.
  std::optional<hal::Metres> antenna_height{};  ///< Above its position, >= 0.
  std::optional<hal::Decibels> antenna_gain{};  ///< The same in all directions.
  std::optional<std::uint32_t> channel{};       ///< 1 .. 14.
  std::optional<Standard> standard{};           ///< Of a network of ieee80211g: 11b, without OFDM.
  std::optional<hal::BitsPerSecond> data_rate{};
  std::optional<hal::BitsPerSecond> control_rate{};
  std::optional<hal::BitsPerSecond> broadcast_rate{};
  /// Names of the access points that it may use, empty: none, it is in an ad hoc network; none:
  /// those of the config (BssConfig). Who is named anywhere is an access point itself.
  std::optional<std::vector<std::string>> access_points{};

  bool operator==(const StationConfig&) const = default;
};

}  // namespace sim::radio
