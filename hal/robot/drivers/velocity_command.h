#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "hal/robot/platform/boot_time.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::robot::drivers {

/// A velocity, body frame, and how long it is in force; without more it is zero.
struct TimedVelocity {
  Twist2 body;
  platform::BootTime until{};

  /// What is to be driven at a time. Whoever writes to a device asks right before that: between any
  /// two instructions the computer may have slept.
  Twist2 at(platform::BootTime now) const { return now < until ? body : Twist2{}; }
};

/// The velocity that a device's thread shall send, handed over by other threads.
class VelocityCommand {
 public:
  struct Numbered {
    TimedVelocity velocity;
    std::uint64_t number = 0;
  };

  /// @param holds_for  how long a velocity is in force, > 0.
  explicit VelocityCommand(Duration holds_for) : holds_for_(holds_for) {}

  /// @param as_of  from when on it is in force.
  /// @return the command's number.
  std::uint64_t set(const Twist2& body, platform::BootTime as_of) {
    const std::scoped_lock lock(mutex_);
    current_ = {{body, as_of + holds_for_}, current_.number + 1};
    return current_.number;
  }
  std::uint64_t stop() { return set({}, {}); }

  /// The velocity is in force anew from then on, unless it had run out before.
  void keep(platform::BootTime as_of) {
    const std::scoped_lock lock(mutex_);
    platform::BootTime& until = current_.velocity.until;
    if (as_of < until) until = std::max(until, as_of + holds_for_);
  }

  Numbered current() const {
    const std::scoped_lock lock(mutex_);
    return current_;
  }

  /// The device has taken the command of that number.
  void confirm(std::uint64_t number) {
    const std::scoped_lock lock(mutex_);
    confirmed_ = number;
    changed_.notify_all();
  }

  /// Whether that command, or a later one, was confirmed in time.
  bool wait_for(std::uint64_t number, Duration at_most) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, at_most, [&] { return confirmed_ >= number; });
  }

 private:
  const Duration holds_for_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Numbered current_;
  std::uint64_t confirmed_ = 0;
};

}  // namespace hal::robot::drivers
