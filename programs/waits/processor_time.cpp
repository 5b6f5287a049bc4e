// Processor time and what else a process has used: POSIX.1-2017, <sys/times.h>, <sys/resource.h>.
// Programs take no time for computing, so that they see virtual time in its place, as by the clocks
// of processor time; what is counted of the computer's (switches, faults) is 0. Memory stays.
#include <sys/resource.h>
#include <sys/times.h>
#include <unistd.h>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/virtual_clock.h"

using programs::waits::kSecond;
using programs::waits::own_slot;

BARAKA_EXPORTED int getrusage(__rusage_who_t whose, rusage* usage) noexcept {
  const int status = BARAKA_NEXT(getrusage)(whose, usage);
  if (status != 0 || own_slot() == nullptr) return status;
  rusage told{};
  told.ru_maxrss = usage->ru_maxrss;
  const timespec used = programs::waits::to_timespec(programs::waits::now());
  told.ru_utime = {used.tv_sec, used.tv_nsec / 1000};
  *usage = told;
  return 0;
}

BARAKA_EXPORTED clock_t times(tms* used) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(times)(used);
  const auto per_second = static_cast<programs::waits::Nanoseconds>(sysconf(_SC_CLK_TCK));
  const auto ticks = [per_second](programs::waits::Nanoseconds time) {
    return static_cast<clock_t>(time / (kSecond / per_second));
  };
  if (used != nullptr) *used = {ticks(programs::waits::now()), 0, 0, 0};
  return ticks(programs::waits::reading(CLOCK_MONOTONIC));
}
