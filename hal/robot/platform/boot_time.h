#pragma once

#include <chrono>

#include "hal/types/clock.h"
#include "hal/types/time.h"

namespace hal::robot::platform {

/// The clock of this computer that never jumps and goes on while the computer is suspended:
/// clock_gettime(2), CLOCK_BOOTTIME. What was said or measured before a suspension is as old as it
/// is afterwards; by std::chrono::steady_clock on Linux it would be as young as before.
struct BootClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<BootClock, duration>;
  static constexpr bool is_steady = true;

  static time_point now() noexcept;  ///< Any thread.
};

using BootTime = BootClock::time_point;

/// The BootClock to be handed in; its time is that since the epoch of the BootClock.
Clock& boot_clock();

}  // namespace hal::robot::platform
