// syscall(2): system calls that programs make without the C library's functions. C++ runtimes wait
// for futexes in this way.
#include <linux/futex.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysinfo.h>
#include <sys/timerfd.h>
#include <sys/times.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>

#include "programs/preload/converted.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"

namespace {

using programs::preload::ForKernel;

using Arguments = std::array<long, 6>;

template <class T>
T* pointer(long argument) {
  return reinterpret_cast<T*>(argument);  // NOLINT(performance-no-int-to-ptr): they come so
}

long pass_on(long number, const Arguments& a) {
  return BARAKA_NEXT(syscall)(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

/// futex(2): the fourth argument is a time-out only in some operations; in most of them it is a
/// point in time.
long futex(const Arguments& a) {
  const auto operation = static_cast<int>(a[1]);
  const auto* const time = pointer<const timespec>(a[3]);
  const clockid_t clock =
      (operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC;
  Arguments kernel = a;
  const auto call = [&kernel](const ForKernel& converted) {
    kernel[3] = reinterpret_cast<long>(converted.get());
    return pass_on(SYS_futex, kernel);
  };
  switch (operation & FUTEX_CMD_MASK) {
    case FUTEX_WAIT:
      return call(ForKernel::duration(time));
    case FUTEX_WAIT_BITSET:
    case FUTEX_WAIT_REQUEUE_PI:
    case FUTEX_LOCK_PI2:
      return call(ForKernel::moment(time, clock));
    case FUTEX_LOCK_PI:
      return call(ForKernel::moment(time, CLOCK_REALTIME));
    default:
      return pass_on(SYS_futex, a);
  }
}

/// Converts the result of clock_nanosleep(), an error number, to that of its system call, which
/// sets errno.
long as_system_call(int error) {
  if (error == 0) return 0;
  errno = error;
  return -1;
}

/// Calls about processor time or times of files.
long counted(long number, const Arguments& a) {
  const auto first = static_cast<int>(a[0]);
  switch (number) {
    case SYS_times:
      return times(pointer<tms>(a[0]));
    case SYS_getrusage:
      return getrusage(static_cast<__rusage_who_t>(first), pointer<rusage>(a[1]));
    case SYS_wait4:
      return wait4(first, pointer<int>(a[1]), static_cast<int>(a[2]), pointer<rusage>(a[3]));
    case SYS_sysinfo:
      return sysinfo(pointer<struct sysinfo>(a[0]));
    case SYS_statx:
      return statx(first, pointer<char>(a[1]), static_cast<int>(a[2]), static_cast<unsigned>(a[3]),
                   pointer<struct statx>(a[4]));
    default:
      return pass_on(number, a);
  }
}

/// Calls with signal sets have the size of the set as a further argument, which the C library
/// supplies itself.
long timed(long number, const Arguments& a) {
  const auto first = static_cast<int>(a[0]);
  switch (number) {
    case SYS_clock_gettime:
      return clock_gettime(static_cast<clockid_t>(a[0]), pointer<timespec>(a[1]));
    case SYS_gettimeofday:
      return gettimeofday(pointer<timeval>(a[0]), pointer<void>(a[1]));
    case SYS_time:
      return time(pointer<time_t>(a[0]));
    case SYS_nanosleep:
      return nanosleep(pointer<timespec>(a[0]), pointer<timespec>(a[1]));
    case SYS_clock_nanosleep:
      return as_system_call(clock_nanosleep(first, static_cast<int>(a[1]), pointer<timespec>(a[2]),
                                            pointer<timespec>(a[3])));
    case SYS_poll:
      return poll(pointer<pollfd>(a[0]), static_cast<nfds_t>(a[1]), static_cast<int>(a[2]));
    case SYS_select:
      return select(first, pointer<fd_set>(a[1]), pointer<fd_set>(a[2]), pointer<fd_set>(a[3]),
                    pointer<timeval>(a[4]));
    case SYS_epoll_wait:
      return epoll_wait(first, pointer<epoll_event>(a[1]), static_cast<int>(a[2]),
                        static_cast<int>(a[3]));
    case SYS_timerfd_settime:
      return timerfd_settime(first, static_cast<int>(a[1]), pointer<itimerspec>(a[2]),
                             pointer<itimerspec>(a[3]));
    case SYS_recvmmsg:
      return recvmmsg(first, pointer<mmsghdr>(a[1]), static_cast<unsigned>(a[2]),
                      static_cast<int>(a[3]), pointer<timespec>(a[4]));
    default:
      return counted(number, a);
  }
}

/// Index of the time-out in calls in which it is an argument with the same meaning.
std::optional<std::size_t> duration_argument(long number) {
  switch (number) {
    case SYS_ppoll:
    case SYS_rt_sigtimedwait:
      return 2;
    case SYS_epoll_pwait2:
    case SYS_semtimedop:
      return 3;
    case SYS_pselect6:
      return 4;
    default:
      return std::nullopt;
  }
}

}  // namespace

BARAKA_EXPORTED long syscall(long number, ...) noexcept {
  Arguments arguments{};
  va_list list;
  va_start(list, number);
  for (long& argument : arguments) argument = va_arg(list, long);
  va_end(list);
  if (number == SYS_futex) return futex(arguments);
  if (number == SYS_epoll_pwait) {
    arguments[3] = programs::preload::milliseconds_for_kernel(static_cast<int>(arguments[3]));
    return pass_on(number, arguments);
  }
  const auto place = duration_argument(number);
  if (!place) return timed(number, arguments);
  // These write the remaining time back; the C library's functions hide that, and so does this.
  const auto converted = ForKernel::duration(pointer<const timespec>(arguments[*place]));
  timespec copy{};
  if (converted.get() != nullptr) {
    copy = *converted.get();
    arguments[*place] = reinterpret_cast<long>(&copy);
  }
  return pass_on(number, arguments);
}
