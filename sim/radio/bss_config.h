#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Time unit of beacon intervals (IEEE Std 802.11-2016, 3.1).
inline constexpr hal::Duration kTimeUnit{1'024'000};

/// Longest SSID, bytes (9.4.2.2).
inline constexpr std::size_t kMaxSsid = 32;

/// Infrastructure mode. The access points and the stations that may use them form one network
/// (extended service set): one SSID, one distribution system behind the access points.
struct BssConfig {
  /// Names of the stations that are access points; other stations may use any of them unless they
  /// say otherwise. Empty: who says nothing is in an ad hoc network.
  std::vector<std::string> access_points{};
  std::string ssid = "baraka";                 ///< 1 .. kMaxSsid bytes.
  hal::Duration beacon_interval{102'400'000};  ///< Whole time units, 1 .. 65535.
  /// By so much another access point's mean beacon must be stronger, dB, >= 0.
  hal::Decibels hysteresis{4};
  double beacon_weight = 0.25;     ///< Of the newest beacon in the mean of RSSI [dBm], 0 < .. <= 1.
  std::uint32_t beacon_loss = 10;  ///< An access point is lost after so many intervals, >= 1.
  hal::Duration scan_time{120'000'000};       ///< > 0; how long to listen for beacons before.
  hal::Duration answer_timeout{200'000'000};  ///< > 0; for the answer to a management frame.
  hal::Duration distribution_delay{};         ///< >= 0; from one access point to another.
};

}  // namespace sim::radio
