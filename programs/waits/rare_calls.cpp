// System calls past the C library of which no program makes many: see raw_calls.cpp.
#include <fcntl.h>
#include <mqueue.h>
#include <sys/epoll.h>
#include <sys/file.h>
#include <sys/msg.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/sendfile.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/sysinfo.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>

#include "programs/waits/kernel_aio.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/signals.h"
#include "programs/waits/turn.h"

#ifndef SYS_futex_waitv
#define SYS_futex_waitv 449
#endif

namespace programs::waits {
namespace {

constexpr long kNotOurs = -2;  ///< No call answers so.

int number_of(long argument) { return static_cast<int>(argument); }
std::size_t size_of(long argument) { return static_cast<std::size_t>(argument); }

timer_t timer_of(long argument) { return pointer<void>(number_of(argument)); }

/// The kernel knows timers by numbers of type int.
long create_timer(const Arguments& a) {
  timer_t made{};
  const int status = timer_create(static_cast<clockid_t>(a[0]), pointer<sigevent>(a[1]), &made);
  if (status == 0) *pointer<int>(a[2]) = static_cast<int>(reinterpret_cast<std::intptr_t>(made));
  return status;
}

long answer_timers(long number, const Arguments& a) {
  const int first = number_of(a[0]);
  switch (number) {
    case SYS_timer_create:
      return create_timer(a);
    case SYS_timer_settime:
      return timer_settime(timer_of(a[0]), number_of(a[1]), pointer<itimerspec>(a[2]),
                           pointer<itimerspec>(a[3]));
    case SYS_timer_gettime:
      return timer_gettime(timer_of(a[0]), pointer<itimerspec>(a[1]));
    case SYS_timer_getoverrun:
      return timer_getoverrun(timer_of(a[0]));
    case SYS_timer_delete:
      return timer_delete(timer_of(a[0]));
    case SYS_timerfd_create:
      return timerfd_create(first, number_of(a[1]));
    case SYS_timerfd_settime:
      return timerfd_settime(first, number_of(a[1]), pointer<itimerspec>(a[2]),
                             pointer<itimerspec>(a[3]));
    case SYS_timerfd_gettime:
      return timerfd_gettime(first, pointer<itimerspec>(a[1]));
    case SYS_setitimer:
      return setitimer(static_cast<__itimer_which_t>(first), pointer<itimerval>(a[1]),
                       pointer<itimerval>(a[2]));
    case SYS_getitimer:
      return getitimer(static_cast<__itimer_which_t>(first), pointer<itimerval>(a[1]));
    case SYS_alarm:
      return alarm(static_cast<unsigned>(a[0]));
    default:
      return kNotOurs;
  }
}

long answer_signals(long number, const Arguments& a) {
  switch (number) {
    case SYS_rt_sigtimedwait:
      return sigtimedwait(pointer<sigset_t>(a[0]), pointer<siginfo_t>(a[1]),
                          pointer<timespec>(a[2]));
    case SYS_pause:
      return pause();
    case SYS_rt_sigsuspend:
      return sigsuspend(pointer<sigset_t>(a[0]));
    case SYS_kill:
    case SYS_tkill:
    case SYS_tgkill:
    case SYS_rt_sigqueueinfo:
    case SYS_rt_tgsigqueueinfo:
    case SYS_pidfd_send_signal:
      return told(pass_on(number, a));
    default:
      return kNotOurs;
  }
}

/// The kernel takes the set of signals together with its size.
long select_with_signals(const Arguments& a) {
  struct Signals {
    const sigset_t* set;
    std::size_t size;
  };
  const auto* const signals = pointer<const Signals>(a[5]);
  return pselect(number_of(a[0]), pointer<fd_set>(a[1]), pointer<fd_set>(a[2]),
                 pointer<fd_set>(a[3]), pointer<timespec>(a[4]),
                 signals == nullptr ? nullptr : signals->set);
}

long answer_descriptors(long number, const Arguments& a) {
  const int first = number_of(a[0]);
  switch (number) {
    case SYS_select:
      return select(first, pointer<fd_set>(a[1]), pointer<fd_set>(a[2]), pointer<fd_set>(a[3]),
                    pointer<timeval>(a[4]));
    case SYS_pselect6:
      return select_with_signals(a);
    case SYS_epoll_pwait:
      return epoll_pwait(first, pointer<epoll_event>(a[1]), number_of(a[2]), number_of(a[3]),
                         pointer<sigset_t>(a[4]));
    case SYS_epoll_pwait2:
      return epoll_pwait2(first, pointer<epoll_event>(a[1]), number_of(a[2]),
                          pointer<timespec>(a[3]), pointer<sigset_t>(a[4]));
    case SYS_recvmmsg:
      return recvmmsg(first, pointer<mmsghdr>(a[1]), static_cast<unsigned>(a[2]), number_of(a[3]),
                      pointer<timespec>(a[4]));
    case SYS_waitid:
      return waitid(static_cast<idtype_t>(first), static_cast<id_t>(a[1]), pointer<siginfo_t>(a[2]),
                    number_of(a[3]));
    case SYS_splice:
      return splice(first, pointer<off64_t>(a[1]), number_of(a[2]), pointer<off64_t>(a[3]),
                    size_of(a[4]), static_cast<unsigned>(a[5]));
    case SYS_tee:
      return tee(first, number_of(a[1]), size_of(a[2]), static_cast<unsigned>(a[3]));
    case SYS_vmsplice:
      return vmsplice(first, pointer<iovec>(a[1]), size_of(a[2]), static_cast<unsigned>(a[3]));
    case SYS_io_submit:
      return submit_to_kernel(a);
    case SYS_io_getevents:
    case SYS_io_pgetevents:
      return get_kernel_events(number, a);
    case SYS_sendfile:
      return sendfile(first, number_of(a[1]), pointer<off_t>(a[2]), size_of(a[3]));
    default:
      return kNotOurs;
  }
}

long answer_queues(long number, const Arguments& a) {
  const int first = number_of(a[0]);
  switch (number) {
    case SYS_semop:
      return semop(first, pointer<sembuf>(a[1]), size_of(a[2]));
    case SYS_semtimedop:
      return semtimedop(first, pointer<sembuf>(a[1]), size_of(a[2]), pointer<timespec>(a[3]));
    case SYS_msgrcv:
      return msgrcv(first, pointer<void>(a[1]), size_of(a[2]), a[3], number_of(a[4]));
    case SYS_msgsnd:
      return msgsnd(first, pointer<void>(a[1]), size_of(a[2]), number_of(a[3]));
    case SYS_mq_timedsend:
      return mq_timedsend(first, pointer<char>(a[1]), size_of(a[2]), static_cast<unsigned>(a[3]),
                          pointer<timespec>(a[4]));
    case SYS_mq_timedreceive:
      return mq_timedreceive(first, pointer<char>(a[1]), size_of(a[2]), pointer<unsigned>(a[3]),
                             pointer<timespec>(a[4]));
    default:
      return kNotOurs;
  }
}

long answer_files(long number, const Arguments& a) {
  const int first = number_of(a[0]);
  switch (number) {
    case SYS_open:
      return open(pointer<char>(a[0]), number_of(a[1]), static_cast<mode_t>(a[2]));
    case SYS_openat:
      return openat(first, pointer<char>(a[1]), number_of(a[2]), static_cast<mode_t>(a[3]));
    case SYS_flock:
      return flock(first, number_of(a[1]));
    case SYS_fcntl:
      return fcntl(first, number_of(a[1]), a[2]);
    case SYS_close:
      return close(first);
    case SYS_dup2:
      return dup2(first, number_of(a[1]));
    case SYS_dup3:
      return dup3(first, number_of(a[1]), number_of(a[2]));
    case SYS_close_range:
      return close_range(static_cast<unsigned>(a[0]), static_cast<unsigned>(a[1]), number_of(a[2]));
    default:
      return kNotOurs;
  }
}

/// @param is_said  once by each process.
long refuse(const char* text, std::atomic<bool>& is_said) {
  if (!is_said.exchange(true)) {
    kernel_call(SYS_write, {STDERR_FILENO, reinterpret_cast<long>(text),
                            static_cast<long>(std::strlen(text)), 0, 0, 0});
  }
  errno = ENOSYS;
  return -1;
}

long refuse_io_uring() {
  static std::atomic<bool> is_said = false;
  return refuse("baraka: io_uring is not available in lock-step\n", is_said);
}

/// Who traces another one waits until it stops, and that one stands still: neither would get a
/// turn.
long refuse_ptrace() {
  static std::atomic<bool> is_said = false;
  return refuse(
      "baraka: ptrace is not available in lock-step; attach debuggers from outside the agent\n",
      is_said);
}

}  // namespace

long answer_rare(long number, const Arguments& a) {
  if (number == SYS_io_uring_setup) return refuse_io_uring();
  if (number == SYS_ptrace) return refuse_ptrace();
  if (number == SYS_futex_waitv) {
    errno = ENOSYS;  // those who ask for it have another way
    return -1;
  }
  if (number == SYS_sysinfo) return sysinfo(pointer<struct sysinfo>(a[0]));
  for (const auto answer_some :
       {answer_files, answer_descriptors, answer_signals, answer_timers, answer_queues}) {
    const long result = answer_some(number, a);
    if (result != kNotOurs) return result;
  }
  return pass_on(number, a);
}

}  // namespace programs::waits
