#include "hal/hardware/platform/boot_time.h"

#include <ctime>

namespace hal::hardware {

BootTime BootClock::now() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);  // cannot fail: the clock is there since Linux 2.6.39
  return BootTime{std::chrono::seconds{now.tv_sec} + std::chrono::nanoseconds{now.tv_nsec}};
}

}  // namespace hal::hardware
