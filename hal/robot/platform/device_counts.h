#pragma once

#include <cstdint>

namespace hal::robot::platform {

/// Statistics of a driver's communication with its device since the start.
struct DeviceCounts {
  /// Times the device was connected; 1: the connection was never lost.
  std::uint64_t connections = 0;
  std::uint64_t failures = 0;      ///< Attempts to connect, and exchanges, that failed.
  std::uint64_t bad_answers = 0;   ///< Failures in which the device's answer violated its protocol.
  std::uint64_t late_refresh = 0;  ///< Commands repeated later than the device's rule allows.
  bool operator==(const DeviceCounts&) const = default;
};

}  // namespace hal::robot::platform
