#pragma once

#include <ctime>
#include <limits>
#include <optional>

#include "programs/waits/turn.h"

namespace programs::waits {

/// What CLOCK_REALTIME says at the start of every run: 1 January 2026, 00:00:00 UTC.
inline constexpr Nanoseconds kEpoch = 1'767'225'600 * kSecond;
/// What the clocks that count from the computer's start say then.
inline constexpr Nanoseconds kUptime = 1000 * kSecond;

/// What a clock says at the start of the run; none: it is a device's, and stays the kernel's.
/// Clocks of processor time begin at 0: programs take none, so these count virtual time, without
/// which a program that waits for its own processor time would never end.
std::optional<Nanoseconds> start_of(clockid_t clock);

/// Of a clock of which start_of() knows.
inline Nanoseconds reading(clockid_t clock) { return *start_of(clock) + now(); }

inline bool is_time(const timespec* time) {
  return time != nullptr && time->tv_sec >= 0 && time->tv_nsec >= 0 && time->tv_nsec < kSecond;
}

/// @pre is_time(). Beyond 100 years: kNever.
inline Nanoseconds nanoseconds(const timespec& time) {
  constexpr time_t kMost = 3'200'000'000;
  return time.tv_sec > kMost ? kNever : time.tv_sec * kSecond + time.tv_nsec;
}

inline timespec to_timespec(Nanoseconds time) { return {time / kSecond, time % kSecond}; }

/// The deadline of a wait of this length; null: kNever.
inline Nanoseconds deadline_in(Nanoseconds length) {
  return length >= kNever - now() ? kNever : now() + length;
}
inline Nanoseconds deadline_in(const timespec* length) {
  return length == nullptr ? kNever : deadline_in(nanoseconds(*length));
}
/// The same of milliseconds as poll() takes them: negative is kNever.
inline Nanoseconds deadline_in_milliseconds(int length) {
  constexpr Nanoseconds kMillisecond = 1'000'000;
  return length < 0 ? kNever : deadline_in(length * kMillisecond);
}

/// The deadline of a wait until a clock says this; null: kNever.
inline Nanoseconds deadline_at(const timespec* moment, clockid_t clock) {
  if (moment == nullptr) return kNever;
  const Nanoseconds time = nanoseconds(*moment);
  return time == kNever ? kNever : time - *start_of(clock);
}

}  // namespace programs::waits
