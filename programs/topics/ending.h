#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace programs::topics {

using Instant = std::chrono::steady_clock::time_point;

/// Lets threads sleep until a time or until the program has to end.
class Ending {
 public:
  /// @return false: the program has to end.
  bool sleep_until(Instant at) {
    std::unique_lock lock(mutex_);
    return !ends_.wait_until(lock, at, [this] { return is_over_; });
  }

  void end() {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    ends_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable ends_;
  bool is_over_ = false;
};

}  // namespace programs::topics
