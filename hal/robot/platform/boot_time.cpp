#include "hal/robot/platform/boot_time.h"

#include <ctime>

namespace hal::robot::platform {
namespace {

class WaitingBootClock final : public Clock {
 public:
  Time now() const override { return Time{BootClock::now().time_since_epoch()}; }
  int wait(std::span<pollfd> descriptors, Duration at_most) override {
    return poll_for(descriptors, at_most);
  }
};

}  // namespace

BootTime BootClock::now() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);  // cannot fail: the clock exists since Linux 2.6.39
  return BootTime{std::chrono::seconds{now.tv_sec} + std::chrono::nanoseconds{now.tv_nsec}};
}

Clock& boot_clock() {
  static WaitingBootClock clock;
  return clock;
}

}  // namespace hal::robot::platform
