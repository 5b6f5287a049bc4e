// Reading the time, and sleeping: POSIX.1-2017, <time.h>, <sys/time.h>, <unistd.h>; C11, 7.27.2.5
// and 7.26.5.7.
#include <sys/time.h>
#include <threads.h>
#include <unistd.h>

#include <cerrno>

#include "programs/preload/converted.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"

using programs::preload::ForKernel;
using programs::preload::kernel_time;
using programs::preload::kSecond;
using programs::preload::ProcessTime;
using programs::preload::to_timespec;

BARAKA_EXPORTED int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int status = BARAKA_NEXT(clock_gettime)(clock, now);
  if (status != 0 || !ProcessTime::get().origin(clock)) return status;
  *now = to_timespec(ProcessTime::get().to_program(programs::preload::nanoseconds(*now), clock));
  return 0;
}

BARAKA_EXPORTED int gettimeofday(timeval* __restrict now, void* __restrict zone) noexcept {
  const int status = BARAKA_NEXT(gettimeofday)(now, zone);
  // The header declares the pointer as never null, but the kernel accepts null for 'only the zone'.
  const timeval* const volatile given = now;
  if (status != 0 || given == nullptr) return status;
  const auto kernel = kernel_time(CLOCK_REALTIME);
  *now = programs::preload::to_timeval(ProcessTime::get().to_program(kernel, CLOCK_REALTIME));
  return 0;
}

BARAKA_EXPORTED time_t time(time_t* now) noexcept {
  const auto kernel = kernel_time(CLOCK_REALTIME);
  const time_t seconds =
      ProcessTime::get().to_program(kernel, CLOCK_REALTIME) / programs::preload::kSecond;
  if (now != nullptr) *now = seconds;
  return seconds;
}

BARAKA_EXPORTED int timespec_get(timespec* now, int base) noexcept {
  if (base != TIME_UTC) return 0;
  return clock_gettime(CLOCK_REALTIME, now) == 0 ? base : 0;
}

BARAKA_EXPORTED int clock_nanosleep(clockid_t clock, int flags, const timespec* time,
                                    timespec* left) {
  if (!ProcessTime::get().origin(clock)) {
    return BARAKA_NEXT(clock_nanosleep)(clock, flags, time, left);
  }
  if ((flags & TIMER_ABSTIME) != 0) {
    const auto until = ForKernel::moment(time, clock);
    return BARAKA_NEXT(clock_nanosleep)(clock, flags, until.get(), left);
  }
  const auto length = ForKernel::duration(time);
  const int status = BARAKA_NEXT(clock_nanosleep)(clock, flags, length.get(), left);
  if (status == EINTR && left != nullptr) *left = programs::preload::for_program(*left);
  return status;
}

BARAKA_EXPORTED int nanosleep(const timespec* time, timespec* left) {
  const auto length = ForKernel::duration(time);
  const int status = BARAKA_NEXT(nanosleep)(length.get(), left);
  if (status != 0 && errno == EINTR && left != nullptr)
    *left = programs::preload::for_program(*left);
  return status;
}

BARAKA_EXPORTED int usleep(useconds_t microseconds) {
  const timespec length = to_timespec(microseconds * std::int64_t{1000});
  return nanosleep(&length, nullptr);
}

BARAKA_EXPORTED unsigned sleep(unsigned seconds) {
  timespec length = to_timespec(seconds * kSecond);
  return nanosleep(&length, &length) == 0 ? 0 : static_cast<unsigned>(length.tv_sec);
}

BARAKA_EXPORTED int thrd_sleep(const timespec* time, timespec* left) {
  constexpr int kInterrupted = -1;
  constexpr int kFailed = -2;
  if (nanosleep(time, left) == 0) return 0;
  return errno == EINTR ? kInterrupted : kFailed;
}
