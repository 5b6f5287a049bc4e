#pragma once

#include <sys/time.h>

#include <ctime>
#include <limits>

#include "programs/preload/process_time.h"

namespace programs::preload {

/// Whether the kernel would accept the time. One that it would not is passed on unchanged, so that
/// the program gets the kernel's error.
inline bool is_time(const timespec* time) {
  return time != nullptr && time->tv_sec >= 0 && time->tv_nsec >= 0 && time->tv_nsec < kSecond;
}
inline bool is_time(const timeval* time) {
  return time != nullptr && time->tv_sec >= 0 && time->tv_usec >= 0 && time->tv_usec < 1'000'000;
}

/// Converts to nanoseconds. @pre is_time(). More than 292 years become the largest number.
inline Nanoseconds nanoseconds(const timespec& time) {
  constexpr Nanoseconds kMost = std::numeric_limits<Nanoseconds>::max();
  if (time.tv_sec > kMost / kSecond - 1) return kMost;
  return time.tv_sec * kSecond + time.tv_nsec;
}
inline Nanoseconds nanoseconds(const timeval& time) {
  return nanoseconds(timespec{time.tv_sec, time.tv_usec * 1000});
}

/// Times before the epoch become the epoch.
inline timespec to_timespec(Nanoseconds time) {
  const Nanoseconds positive = time < 0 ? 0 : time;
  return {positive / kSecond, positive % kSecond};
}
inline timeval to_timeval(Nanoseconds time) {
  const timespec whole = to_timespec(time);
  return {whole.tv_sec, whole.tv_nsec / 1000};
}
/// Microseconds, rounded up.
inline timeval to_timeval_up(Nanoseconds time) {
  return to_timeval(time > std::numeric_limits<Nanoseconds>::max() - 999 ? time : time + 999);
}

/// A time-out or a point in time given by a program, converted for the kernel.
class ForKernel {
 public:
  static ForKernel duration(const timespec* time) {
    ForKernel result(time);
    if (is_time(time)) {
      result.converted_ = to_timespec(ProcessTime::get().dilation().to_kernel(nanoseconds(*time)));
    }
    return result;
  }
  static ForKernel moment(const timespec* time, clockid_t clock) {
    ForKernel result(time);
    if (is_time(time)) {
      result.converted_ = to_timespec(ProcessTime::get().to_kernel(nanoseconds(*time), clock));
    }
    return result;
  }
  /// If null or not a time was given, that is returned. Valid as long as this object.
  const timespec* get() const { return is_time(given_) ? &converted_ : given_; }

 private:
  explicit ForKernel(const timespec* given) : given_(given) {}

  const timespec* given_;
  timespec converted_{};
};

/// Converts a duration of the kernel for the program.
inline timespec for_program(const timespec& time) {
  return to_timespec(ProcessTime::get().dilation().to_program(nanoseconds(time)));
}
inline timeval for_program(const timeval& time) {
  return to_timeval(ProcessTime::get().dilation().to_program(nanoseconds(time)));
}

/// Converts the time-out of poll() and similar calls in milliseconds, rounded up; negative: no
/// limit.
inline int milliseconds_for_kernel(int timeout) {
  if (timeout <= 0) return timeout;
  constexpr Nanoseconds kMillisecond = 1'000'000;
  constexpr Nanoseconds kMost = std::numeric_limits<int>::max();
  const Nanoseconds asked = ProcessTime::get().dilation().to_kernel(timeout * kMillisecond);
  const Nanoseconds rounded = (asked + kMillisecond - 1) / kMillisecond;
  return static_cast<int>(rounded < kMost ? rounded : kMost);
}

}  // namespace programs::preload
