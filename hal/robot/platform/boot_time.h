#pragma once

#include <chrono>

#include "hal/types/clock.h"
#include "hal/types/time.h"

namespace hal::robot::platform {

/// The monotonic clock of this computer that continues during suspension: clock_gettime(2),
/// CLOCK_BOOTTIME. After a suspension, commands and measurements from before it have their true
/// age; std::chrono::steady_clock on Linux does not count the suspension.
struct BootClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<BootClock, duration>;
  static constexpr bool is_steady = true;

  static time_point now() noexcept;  ///< Any thread.
};

using BootTime = BootClock::time_point;

/// The BootClock as a Clock object; its times count from the epoch of the BootClock.
Clock& boot_clock();

}  // namespace hal::robot::platform
