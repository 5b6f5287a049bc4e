// syscall(2): what programs ask of the kernel past the C library's calls. C++ and Rust wait for
// futexes so.
#include <linux/futex.h>
#include <poll.h>
#include <sched.h>
#include <sys/epoll.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/times.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <ctime>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/handlers.h"
#include "programs/waits/inheriting_futex.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/parking.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::own_slot;
using programs::waits::pass_on;
using programs::waits::pointer;
using programs::waits::Woken;

using programs::waits::Arguments;

long failed(int error) {
  errno = error;
  return -1;
}

std::uint64_t object_of(const Arguments& a) {
  const bool is_private = (a[1] & FUTEX_PRIVATE_FLAG) != 0;
  return is_private ? programs::waits::object_at(pointer<void>(a[0]))
                    : programs::waits::kSharedObject;
}

long wait_for_futex(const Arguments& a, programs::waits::Nanoseconds deadline) {
  const auto& word = *pointer<std::atomic<std::uint32_t>>(a[0]);
  const unsigned before = programs::waits::interruptions();
  for (;;) {
    if (word.load() != static_cast<std::uint32_t>(a[2])) return failed(EAGAIN);
    switch (programs::waits::park(object_of(a), deadline)) {
      case Woken::kByThread:
        return 0;
      case Woken::kByDeadline:
        return failed(ETIMEDOUT);
      case Woken::kBySignal:
        break;
    }
    if (deadline != programs::waits::kNever || programs::waits::interruptions() != before)
      return failed(EINTR);
  }
}

/// Those with priority inheritance; others are the kernel's.
long futex_of_owner(const Arguments& a) {
  constexpr int kLock2 = 13;  // FUTEX_LOCK_PI2, since Linux 5.14: CLOCK_MONOTONIC by default
  const auto operation = static_cast<int>(a[1]);
  const bool is_of_real_time = (operation & FUTEX_CLOCK_REALTIME) != 0;
  const auto deadline = [&](clockid_t clock) {
    return programs::waits::deadline_at(pointer<const timespec>(a[3]), clock);
  };
  switch (operation & FUTEX_CMD_MASK) {
    case FUTEX_LOCK_PI:
      return programs::waits::lock_inheriting(a, object_of(a), deadline(CLOCK_REALTIME));
    case kLock2:
      return programs::waits::lock_inheriting(
          a, object_of(a), deadline(is_of_real_time ? CLOCK_REALTIME : CLOCK_MONOTONIC));
    case FUTEX_TRYLOCK_PI:
      return programs::waits::try_inheriting(a);
    case FUTEX_UNLOCK_PI:
      return programs::waits::unlock_inheriting(a, object_of(a),
                                                (operation & FUTEX_PRIVATE_FLAG) != 0);
    default:
      return pass_on(SYS_futex, a);
  }
}

/// Others that wait by the kernel's own call are woken, too.
long futex(const Arguments& a) {
  const auto operation = static_cast<int>(a[1]);
  const auto* const time = pointer<const timespec>(a[3]);
  const clockid_t clock =
      (operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC;
  switch (operation & FUTEX_CMD_MASK) {
    case FUTEX_WAIT:
      return wait_for_futex(a, programs::waits::deadline_in(time));
    case FUTEX_WAIT_BITSET:
      return wait_for_futex(a, programs::waits::deadline_at(time, clock));
    case FUTEX_WAKE:
    case FUTEX_WAKE_BITSET: {
      const bool is_private = (operation & FUTEX_PRIVATE_FLAG) != 0;
      const auto most = static_cast<unsigned>(a[2]);
      const unsigned parked = programs::waits::wake(object_of(a), is_private ? most : ~0U);
      const long others = pass_on(SYS_futex, a);
      return others < 0 ? others : others + parked;
    }
    case FUTEX_REQUEUE:
    case FUTEX_CMP_REQUEUE:
    case FUTEX_WAKE_OP:
      programs::waits::wake(object_of(a), ~0U);
      return pass_on(SYS_futex, a);
    default:
      return futex_of_owner(a);
  }
}

/// clock_nanosleep() returns the error, its system call sets errno.
long as_system_call(int error) { return error == 0 ? 0 : failed(error); }

/// A process by clone(2) is made as by fork(). Threads that are made past the C library are not
/// known to the run, and would begin on a stack that is not theirs here.
long clone_of(const Arguments& a) {
  const bool is_process = (a[0] & (CLONE_VM | CLONE_THREAD)) == 0 && a[1] == 0;
  return is_process ? fork() : failed(ENOSYS);
}

/// Those of descriptors.
long transfer(long number, const Arguments& a) {
  const auto first = static_cast<int>(a[0]);
  const auto size = static_cast<std::size_t>(a[2]);
  switch (number) {
    case SYS_read:
      return read(first, pointer<void>(a[1]), size);
    case SYS_readv:
      return readv(first, pointer<iovec>(a[1]), static_cast<int>(a[2]));
    case SYS_write:
      return write(first, pointer<void>(a[1]), size);
    case SYS_writev:
      return writev(first, pointer<iovec>(a[1]), static_cast<int>(a[2]));
    case SYS_recvfrom:
      return recvfrom(first, pointer<void>(a[1]), size, static_cast<int>(a[3]),
                      pointer<sockaddr>(a[4]), pointer<socklen_t>(a[5]));
    case SYS_recvmsg:
      return recvmsg(first, pointer<msghdr>(a[1]), static_cast<int>(a[2]));
    case SYS_sendto:
      return sendto(first, pointer<void>(a[1]), size, static_cast<int>(a[3]),
                    pointer<sockaddr>(a[4]), static_cast<socklen_t>(a[5]));
    case SYS_sendmsg:
      return sendmsg(first, pointer<msghdr>(a[1]), static_cast<int>(a[2]));
    case SYS_sendmmsg:
      return sendmmsg(first, pointer<mmsghdr>(a[1]), static_cast<unsigned>(a[2]),
                      static_cast<int>(a[3]));
    case SYS_accept:
      return accept(first, pointer<sockaddr>(a[1]), pointer<socklen_t>(a[2]));
    case SYS_accept4:
      return accept4(first, pointer<sockaddr>(a[1]), pointer<socklen_t>(a[2]),
                     static_cast<int>(a[3]));
    case SYS_connect:
      return connect(first, pointer<sockaddr>(a[1]), static_cast<socklen_t>(a[2]));
    case SYS_bind:
      return bind(first, pointer<sockaddr>(a[1]), static_cast<socklen_t>(a[2]));
    case SYS_fork:
    case SYS_vfork:
      return fork();
    case SYS_clone:
      return clone_of(a);
    case SYS_clone3:
      return failed(ENOSYS);  // the C library then takes clone()
    case SYS_wait4:
      return wait4(first, pointer<int>(a[1]), static_cast<int>(a[2]), pointer<rusage>(a[3]));
    default:
      return programs::waits::answer_rare(number, a);
  }
}

}  // namespace

long programs::waits::pass_on(long number, const Arguments& a) {
  constexpr long kMostErrors = 4095;
  const long result = kernel_call(number, a);
  return_from_call();
  return result < 0 && result >= -kMostErrors ? failed(static_cast<int>(-result)) : result;
}

long programs::waits::answer(long number, const Arguments& a) {
  const auto first = static_cast<int>(a[0]);
  switch (number) {
    case SYS_futex:
      return futex(a);
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
    case SYS_ppoll:
      return ppoll(pointer<pollfd>(a[0]), static_cast<nfds_t>(a[1]), pointer<timespec>(a[2]),
                   pointer<sigset_t>(a[3]));
    case SYS_epoll_wait:
      return epoll_wait(first, pointer<epoll_event>(a[1]), static_cast<int>(a[2]),
                        static_cast<int>(a[3]));
    case SYS_getrusage:
      return getrusage(static_cast<__rusage_who_t>(first), pointer<rusage>(a[1]));
    case SYS_times:
      return times(pointer<tms>(a[0]));
    case SYS_getrandom:
      return getrandom(pointer<void>(a[0]), static_cast<size_t>(a[1]), static_cast<unsigned>(a[2]));
    default:
      return transfer(number, a);
  }
}

BARAKA_EXPORTED long syscall(long number, ...) noexcept {
  Arguments arguments{};
  va_list list;
  va_start(list, number);
  for (long& argument : arguments) argument = va_arg(list, long);
  va_end(list);
  return own_slot() == nullptr ? pass_on(number, arguments)
                               : programs::waits::answer(number, arguments);
}
