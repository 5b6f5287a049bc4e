#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "hal/robot/platform/boot_time.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::robot::drivers {

/// A velocity in the body frame with its expiry; after that the velocity is zero.
struct TimedVelocity {
  Twist2 body;
  platform::BootTime until{};

  /// The velocity at a time. Call it right before writing to a device: the computer may be
  /// suspended between any two instructions.
  Twist2 at(platform::BootTime now) const { return now < until ? body : Twist2{}; }
};

/// The velocity for a device's thread to send, set by other threads.
class VelocityCommand {
 public:
  struct Numbered {
    TimedVelocity velocity;
    std::uint64_t number = 0;
  };

  /// @param holds_for  how long a velocity is valid, > 0.
  explicit VelocityCommand(Duration holds_for) : holds_for_(holds_for) {}

  /// @param as_of  start of its validity.
  /// @return the command's number.
  std::uint64_t set(const Twist2& body, platform::BootTime as_of) {
    const std::scoped_lock lock(mutex_);
    current_ = {{body, as_of + holds_for_}, current_.number + 1};
    return current_.number;
  }
  std::uint64_t stop() { return set({}, {}); }

  /// Restarts the validity of the velocity at that time, unless it had expired before.
  void keep(platform::BootTime as_of) {
    const std::scoped_lock lock(mutex_);
    platform::BootTime& until = current_.velocity.until;
    if (as_of < until) until = std::max(until, as_of + holds_for_);
  }

  Numbered current() const {
    const std::scoped_lock lock(mutex_);
    return current_;
  }

  /// The device has accepted the command with this number.
  void confirm(std::uint64_t number) {
    const std::scoped_lock lock(mutex_);
    confirmed_ = number;
    changed_.notify_all();
  }

  /// Whether this command, or a later one, was confirmed in time.
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
