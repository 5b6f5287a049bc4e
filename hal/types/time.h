#pragma once

#include <chrono>
#include <cstdint>

namespace hal {

/// Elapsed time, integer nanoseconds. Never floating point: sums are exact, so every run orders
/// the same events the same way. Range: +-292 years.
using Duration = std::chrono::duration<std::int64_t, std::nano>;

/// The clock a controller lives by: simulated time in sim/, a monotonic clock on a real robot.
/// It has no now(); time is always handed in, so no code can read the wall clock by accident.
struct WorldClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<WorldClock>;
  static constexpr bool is_steady = true;
};

/// Point on WorldClock; the start of a run is Time{}. `Time + Time` does not compile.
using Time = WorldClock::time_point;

/// Seconds as double. Only for the borders that need it: the ODE step, log lines, tables.
constexpr double to_seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
constexpr double to_seconds(Time t) { return to_seconds(t.time_since_epoch()); }

/// Nearest nanosecond, halves away from zero. @pre |seconds| < 9e9.
constexpr Duration from_seconds(double seconds) {
  const double ns = seconds * 1e9;
  return Duration{static_cast<std::int64_t>(ns < 0 ? ns - 0.5 : ns + 0.5)};
}

/// Nanoseconds since the start of the run, as they are stored, sent and fingerprinted.
constexpr std::int64_t to_ns(Time t) { return t.time_since_epoch().count(); }
constexpr Time time_from_ns(std::int64_t ns) { return Time{Duration{ns}}; }

/// Number a controller gives a timer of its own.
using TimerId = std::uint32_t;

}  // namespace hal
