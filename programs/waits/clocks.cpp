// What a program reads of the time, and sleeps: POSIX.1-2017, <time.h>, <sys/time.h>, <unistd.h>,
// <sched.h>; C11, 7.27.2.5 and 7.26.5.7.
#include <sched.h>
#include <sys/time.h>
#include <threads.h>
#include <unistd.h>

#include <cerrno>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/virtual_clock.h"

namespace programs::waits {

std::optional<Nanoseconds> start_of(clockid_t clock) {
  // Of a process or thread, also of another one: negative numbers, of whose lowest two bits 3
  // stands for a device (include/linux/posix-timers.h of Linux).
  constexpr clockid_t kKind = 3, kDevice = 3;
  if (clock < 0) return (clock & kKind) == kDevice ? std::nullopt : std::optional<Nanoseconds>(0);
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
    case CLOCK_REALTIME_ALARM:
    case CLOCK_TAI:
      return kEpoch;
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_COARSE:
    case CLOCK_MONOTONIC_RAW:
    case CLOCK_BOOTTIME:
    case CLOCK_BOOTTIME_ALARM:
      return kUptime;
    case CLOCK_PROCESS_CPUTIME_ID:
    case CLOCK_THREAD_CPUTIME_ID:
      return 0;
    default:
      return std::nullopt;
  }
}

}  // namespace programs::waits

using programs::waits::count_look;
using programs::waits::is_time;
using programs::waits::own_slot;
using programs::waits::reading;

BARAKA_EXPORTED int clock_gettime(clockid_t clock, timespec* now) noexcept {
  if (own_slot() == nullptr || !programs::waits::start_of(clock)) {
    return BARAKA_NEXT(clock_gettime)(clock, now);
  }
  count_look(1);
  *now = programs::waits::to_timespec(reading(clock));
  return 0;
}

BARAKA_EXPORTED int gettimeofday(timeval* __restrict now, void* __restrict zone) noexcept {
  const timeval* const volatile given = now;
  if (own_slot() == nullptr || given == nullptr) return BARAKA_NEXT(gettimeofday)(now, zone);
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  *now = {time.tv_sec, time.tv_nsec / 1000};
  return 0;
}

BARAKA_EXPORTED time_t time(time_t* now) noexcept {
  timespec read{};
  clock_gettime(CLOCK_REALTIME, &read);
  if (now != nullptr) *now = read.tv_sec;
  return read.tv_sec;
}

BARAKA_EXPORTED int timespec_get(timespec* now, int base) noexcept {
  if (base != TIME_UTC) return 0;
  return clock_gettime(CLOCK_REALTIME, now) == 0 ? base : 0;
}

BARAKA_EXPORTED clock_t clock() noexcept {
  timespec read{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &read);
  constexpr clock_t kNanosecondsPerClock = 1'000'000'000 / CLOCKS_PER_SEC;
  return read.tv_sec * CLOCKS_PER_SEC + read.tv_nsec / kNanosecondsPerClock;
}

BARAKA_EXPORTED int clock_nanosleep(clockid_t clock, int flags, const timespec* time,
                                    timespec* left) {
  const bool is_ours = own_slot() != nullptr && programs::waits::start_of(clock) && is_time(time);
  if (!is_ours) return BARAKA_NEXT(clock_nanosleep)(clock, flags, time, left);
  programs::waits::cancellation_point();
  const bool is_moment = (flags & TIMER_ABSTIME) != 0;
  const auto until =
      is_moment ? programs::waits::deadline_at(time, clock) : programs::waits::deadline_in(time);
  if (programs::waits::sleep_until(until)) return 0;
  programs::waits::cancellation_point();
  if (!is_moment && left != nullptr)
    *left = programs::waits::to_timespec(until - programs::waits::now());
  return EINTR;
}

BARAKA_EXPORTED int nanosleep(const timespec* time, timespec* left) {
  if (own_slot() == nullptr) return BARAKA_NEXT(nanosleep)(time, left);
  const int error = is_time(time) ? clock_nanosleep(CLOCK_MONOTONIC, 0, time, left) : EINVAL;
  if (error == 0) return 0;
  errno = error;
  return -1;
}

BARAKA_EXPORTED int usleep(useconds_t microseconds) {
  constexpr useconds_t kMillion = 1'000'000;
  const timespec length{microseconds / kMillion, static_cast<long>(microseconds % kMillion) * 1000};
  return nanosleep(&length, nullptr);
}

BARAKA_EXPORTED unsigned sleep(unsigned seconds) {
  timespec length{static_cast<time_t>(seconds), 0};
  return nanosleep(&length, &length) == 0 ? 0 : static_cast<unsigned>(length.tv_sec);
}

BARAKA_EXPORTED int thrd_sleep(const timespec* time, timespec* left) {
  constexpr int kInterrupted = -1, kFailed = -2;
  if (nanosleep(time, left) == 0) return 0;
  return errno == EINTR ? kInterrupted : kFailed;
}

BARAKA_EXPORTED int sched_yield() noexcept {
  constexpr unsigned kAsManyLooks = 20;
  count_look(kAsManyLooks);
  return 0;
}
