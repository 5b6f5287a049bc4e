#pragma once

#include <cstdint>
#include <ctime>

namespace programs::lockstep {

inline constexpr std::int64_t kMicrosecond = 1000;  ///< ns
inline constexpr std::int64_t kMillisecond = 1'000'000;
inline constexpr std::int64_t kSecond = 1'000'000'000;

/// ns since some time in the past. Any thread.
inline std::int64_t wall_time() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

}  // namespace programs::lockstep
