#pragma once

#include <cstdint>

namespace hal::robot::platform {

/// How a driver got on with its device since the start.
struct DeviceCounts {
  std::uint64_t connections = 0;   ///< Times the device was reached anew; 1: never lost.
  std::uint64_t failures = 0;      ///< Attempts to connect, and exchanges, that failed.
  std::uint64_t bad_answers = 0;   ///< Of the failures: the device answered against its protocol.
  std::uint64_t late_refresh = 0;  ///< Commands repeated later than the device's rule allows.
  bool operator==(const DeviceCounts&) const = default;
};

}  // namespace hal::robot::platform
