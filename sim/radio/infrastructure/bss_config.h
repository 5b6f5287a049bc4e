#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/mac/edca_config.h"

namespace sim::radio {

/// Time unit of beacon intervals (IEEE Std 802.11-2016, 3.1).
inline constexpr hal::Duration kTimeUnit{1'024'000};

/// Longest SSID, bytes (9.4.2.2).
inline constexpr std::size_t kMaxSsid = 32;

/// Infrastructure mode. The access points and their stations form one extended service set with one
/// SSID and one distribution system.
struct BssConfig {
  /// Names of the stations that are access points. Other stations may use any of them unless
  /// StationConfig::access_points restricts it. Empty: ad hoc network by default.
  std::vector<std::string> access_points{};
  std::string ssid = "baraka";                 ///< 1 .. kMaxSsid bytes.
  hal::Duration beacon_interval{102'400'000};  ///< Whole time units, 1 .. 65535.
  /// >= 0. Handover if the mean RSSI of another access point is greater by more than this.
  hal::Decibels hysteresis{4};
  /// Weight of the newest beacon in the mean RSSI [dBm], 0 < .. <= 1.
  double beacon_weight = 0.25;
  std::uint32_t beacon_loss = 10;  ///< Missed beacons after which an access point is lost, >= 1.
  hal::Duration scan_time{120'000'000};  ///< Time to listen for beacons before association, > 0.
  /// Time to wait for the response to a management frame, > 0.
  hal::Duration answer_timeout{200'000'000};
  hal::Duration distribution_delay{};  ///< Delay from one access point to another, >= 0.
  /// EDCA parameters that access points announce, and their stations use; without lifetimes.
  /// nullopt: DcfConfig::edca.
  std::optional<EdcaConfig> edca{};
};

}  // namespace sim::radio
