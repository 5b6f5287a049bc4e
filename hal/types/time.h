#pragma once

#include <chrono>
#include <cstdint>

namespace hal {

/// Elapsed time, integer nanoseconds. Never floating point: sums are exact, so every run orders
/// the same events the same way. Range: +-292 years.
using Duration = std::chrono::duration<std::int64_t, std::nano>;

/// The clock of controllers: simulated time in sim/, a monotonic clock on a real robot. It has no
/// now(): time is a parameter everywhere, so no code can read the wall clock by accident. The
/// members are those of a Clock of the C++ standard, [time.clock.req].
struct WorldClock {
  using duration = Duration;                               ///< Nanoseconds.
  using rep = duration::rep;                               ///< 64-bit integer.
  using period = duration::period;                         ///< 1e-9 s.
  using time_point = std::chrono::time_point<WorldClock>;  ///< Time.
  static constexpr bool is_steady = true;                  ///< It never goes back.
};

/// Point on WorldClock; the start of a run is Time{}. `Time + Time` does not compile.
using Time = WorldClock::time_point;

/// Seconds as double. Only for interfaces that need it: the ODE step, log lines, tables.
constexpr double to_seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
/// Seconds since the start of the run.
constexpr double to_seconds(Time t) { return to_seconds(t.time_since_epoch()); }

/// Nearest nanosecond, halves away from zero. @pre |seconds| < 9e9.
constexpr Duration from_seconds(double seconds) {
  const double ns = seconds * 1e9;
  return Duration{static_cast<std::int64_t>(ns < 0 ? ns - 0.5 : ns + 0.5)};
}

/// Nanoseconds since the start of the run, as they are stored, sent and fingerprinted.
constexpr std::int64_t to_ns(Time t) { return t.time_since_epoch().count(); }
/// The time with this to_ns().
constexpr Time time_from_ns(std::int64_t ns) { return Time{Duration{ns}}; }

/// Number by which a controller names one of its timers.
using TimerId = std::uint32_t;

}  // namespace hal
