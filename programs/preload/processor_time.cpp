// Processor time and other values counted in ticks: POSIX.1-2017, <sys/times.h>, <sys/resource.h>,
// <time.h>; wait4(2), sysinfo(2), prlimit(2) of Linux.
//
// A program's processor time is slowed like its clock. So it does not exceed the elapsed time times
// the number of processors, as programs expect that divide the two: load meters, limiters of busy
// loops, profilers. For the program, its processor is faster by the factor by which its time is
// slower.
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <sys/times.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "programs/preload/converted.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"

namespace {

using programs::preload::Dilation;
using programs::preload::kernel_time;
using programs::preload::kSecond;
using programs::preload::Nanoseconds;
using programs::preload::ProcessTime;

const Dilation& dilation() { return ProcessTime::get().dilation(); }

void convert(rusage& usage) {
  usage.ru_utime = programs::preload::for_program(usage.ru_utime);
  usage.ru_stime = programs::preload::for_program(usage.ru_stime);
}

/// Converts RLIMIT_CPU [s]; other limits are unchanged.
template <class Limit>
void to_kernel(int resource, Limit& limit) {
  if (resource != RLIMIT_CPU) return;
  constexpr rlim_t kMost = std::numeric_limits<Nanoseconds>::max();
  for (auto* const one : {&limit.rlim_cur, &limit.rlim_max}) {
    if (*one == RLIM_INFINITY) continue;
    *one =
        static_cast<rlim_t>(dilation().to_kernel(static_cast<Nanoseconds>(std::min(*one, kMost))));
  }
}

template <class Limit>
void to_program(int resource, Limit& limit) {
  if (resource != RLIMIT_CPU) return;
  for (auto* const one : {&limit.rlim_cur, &limit.rlim_max}) {
    if (*one == RLIM_INFINITY) continue;
    *one = static_cast<rlim_t>(dilation().to_program(static_cast<Nanoseconds>(*one)));
  }
}

/// @param limit  from the program; null: none. @param before  where the previous limit is stored;
/// null: nowhere. @param call  called with the kernel's limit.
template <class Limit, class Call>
int limited(int resource, const Limit* limit, Limit* before, Call call) {
  Limit kernel{};
  if (limit != nullptr) {
    kernel = *limit;
    to_kernel(resource, kernel);
  }
  const int status = call(limit == nullptr ? nullptr : &kernel);
  if (status == 0 && before != nullptr) to_program(resource, *before);
  return status;
}

}  // namespace

BARAKA_EXPORTED clock_t clock() noexcept {
  if (dilation().is_none()) return BARAKA_NEXT(clock)();
  constexpr Nanoseconds kNanosecondsPerTick = kSecond / CLOCKS_PER_SEC;
  return dilation().to_program(kernel_time(CLOCK_PROCESS_CPUTIME_ID)) / kNanosecondsPerTick;
}

/// The result counts from 'an arbitrary point in the past': if time is slowed, from the same point
/// as the slowed CLOCK_MONOTONIC.
BARAKA_EXPORTED clock_t times(tms* usage) noexcept {
  const clock_t kernel = BARAKA_NEXT(times)(usage);
  if (dilation().is_none() || kernel == static_cast<clock_t>(-1)) return kernel;
  if (usage != nullptr) {
    for (clock_t* const one :
         {&usage->tms_utime, &usage->tms_stime, &usage->tms_cutime, &usage->tms_cstime}) {
      *one = dilation().to_program(*one);
    }
  }
  const Nanoseconds now =
      ProcessTime::get().to_program(kernel_time(CLOCK_MONOTONIC), CLOCK_MONOTONIC);
  return now / (kSecond / sysconf(_SC_CLK_TCK));
}

BARAKA_EXPORTED int getrusage(__rusage_who_t who, rusage* usage) noexcept {
  const int status = BARAKA_NEXT(getrusage)(who, usage);
  if (status == 0) convert(*usage);
  return status;
}

BARAKA_EXPORTED pid_t wait4(pid_t process, int* status, int options, rusage* usage) noexcept {
  const pid_t ended = BARAKA_NEXT(wait4)(process, status, options, usage);
  if (ended > 0 && usage != nullptr) convert(*usage);
  return ended;
}

BARAKA_EXPORTED pid_t wait3(int* status, int options, rusage* usage) noexcept {
  return wait4(-1, status, options, usage);
}

/// Seconds are rounded up, as by the kernel. Load averages are those of the computer.
BARAKA_EXPORTED int sysinfo(struct sysinfo* told) noexcept {
  const int status = BARAKA_NEXT(sysinfo)(told);
  if (status != 0 || dilation().is_none()) return status;
  const Nanoseconds up = ProcessTime::get().to_program(kernel_time(CLOCK_BOOTTIME), CLOCK_BOOTTIME);
  told->uptime = (up + kSecond - 1) / programs::preload::kSecond;
  return status;
}

// Functions with 64 in their names are called by programs compiled for large files.

BARAKA_EXPORTED int prlimit(pid_t process, __rlimit_resource resource, const rlimit* limit,
                            rlimit* before) noexcept {
  return limited(resource, limit, before, [=](const rlimit* kernel) {
    return BARAKA_NEXT(prlimit)(process, resource, kernel, before);
  });
}

BARAKA_EXPORTED int prlimit64(pid_t process, __rlimit_resource resource, const rlimit64* limit,
                              rlimit64* before) noexcept {
  return limited(resource, limit, before, [=](const rlimit64* kernel) {
    return BARAKA_NEXT(prlimit64)(process, resource, kernel, before);
  });
}

// The runtime of the address sanitizer reads limits before its shadow memory exists, so it must not
// be answered by instrumented code.
#ifndef __SANITIZE_ADDRESS__

BARAKA_EXPORTED int getrlimit(__rlimit_resource_t resource, rlimit* limit) noexcept {
  const rlimit* const none = nullptr;
  return limited(resource, none, limit,
                 [=](const rlimit*) { return BARAKA_NEXT(getrlimit)(resource, limit); });
}

BARAKA_EXPORTED int getrlimit64(__rlimit_resource_t resource, rlimit64* limit) noexcept {
  const rlimit64* const none = nullptr;
  return limited(resource, none, limit,
                 [=](const rlimit64*) { return BARAKA_NEXT(getrlimit64)(resource, limit); });
}

BARAKA_EXPORTED int setrlimit(__rlimit_resource_t resource, const rlimit* limit) noexcept {
  rlimit* const none = nullptr;
  return limited(resource, limit, none,
                 [=](const rlimit* kernel) { return BARAKA_NEXT(setrlimit)(resource, kernel); });
}

BARAKA_EXPORTED int setrlimit64(__rlimit_resource_t resource, const rlimit64* limit) noexcept {
  rlimit64* const none = nullptr;
  return limited(resource, limit, none, [=](const rlimit64* kernel) {
    return BARAKA_NEXT(setrlimit64)(resource, kernel);
  });
}

#endif
