#pragma once

#include <fmt/format.h>

#include <mutex>
#include <optional>
#include <utility>

#include "hal/robot/platform/boot_time.h"
#include "hal/robot/platform/device_thread.h"
#include "hal/types/result.h"
#include "hal/types/time.h"

namespace hal::robot::platform {

/// The last value from a device's thread, for other threads; `T` has a `stamp`. A value that is too
/// old is not returned.
template <class T>
class Latest {
 public:
  explicit Latest(Duration stale_after) : stale_after_(stale_after) {}

  void set(T value) {
    const std::scoped_lock lock(mutex_);
    value_ = std::move(value);
  }

  /// Errors: kNotConnected, kNotAvailable, kTimeout.
  Result<T> get(const DeviceThread& thread) const {
    const auto age_limit = BootClock::now() - stale_after_;
    const std::scoped_lock lock(mutex_);
    if (value_ && value_->stamp >= age_limit) return *value_;
    if (const std::string trouble = thread.trouble(); !trouble.empty()) {
      return fail(Errc::kNotConnected, trouble);
    }
    if (!value_) return fail(Errc::kNotAvailable, "no reading yet");
    return fail(Errc::kTimeout,
                fmt::format("no reading for more than {} s", to_seconds(stale_after_)));
  }

 private:
  const Duration stale_after_;
  mutable std::mutex mutex_;
  std::optional<T> value_;
};

}  // namespace hal::robot::platform
