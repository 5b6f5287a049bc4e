#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::hardware {

/// The velocity that a device's thread shall send, handed over by other threads.
class VelocityCommand {
 public:
  struct Numbered {
    Twist2 body;
    std::uint64_t number = 0;
  };

  /// @return the command's number.
  std::uint64_t set(const Twist2& body) {
    const std::scoped_lock lock(mutex_);
    current_ = {body, current_.number + 1};
    return current_.number;
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
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Numbered current_;
  std::uint64_t confirmed_ = 0;
};

}  // namespace hal::hardware
