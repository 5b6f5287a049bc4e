// Waits for descriptors and signals: POSIX.1-2017, <poll.h>, <sys/select.h>, <signal.h>; epoll(7).
#include <poll.h>
#include <sys/epoll.h>
#include <sys/select.h>

#include <csignal>

#include "gateway/dilate/converted.h"
#include "gateway/dilate/exported.h"
#include "gateway/dilate/intercepted.h"

using gateway::dilate::ForKernel;
using gateway::dilate::milliseconds_for_kernel;

extern "C" {
/// What the GNU C library's headers call in place of poll() and ppoll() when they know how large
/// the array is (_FORTIFY_SOURCE).
int checked_poll(pollfd* descriptors, nfds_t count, int timeout,
                 std::size_t size) __asm__("__poll_chk");
int checked_ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                  const sigset_t* signals, std::size_t size) __asm__("__ppoll_chk");
[[noreturn]] void fail_check() __asm__("__chk_fail");
}

BARAKA_EXPORTED int poll(pollfd* descriptors, nfds_t count, int timeout) {
  return BARAKA_NEXT(poll)(descriptors, count, milliseconds_for_kernel(timeout));
}

BARAKA_EXPORTED int ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                          const sigset_t* signals) {
  const auto kernel = ForKernel::duration(timeout);
  return BARAKA_NEXT(ppoll)(descriptors, count, kernel.get(), signals);
}

BARAKA_EXPORTED int checked_poll(pollfd* descriptors, nfds_t count, int timeout, std::size_t size) {
  if (size / sizeof(pollfd) < count) fail_check();
  return poll(descriptors, count, timeout);
}

BARAKA_EXPORTED int checked_ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                                  const sigset_t* signals, std::size_t size) {
  if (size / sizeof(pollfd) < count) fail_check();
  return ppoll(descriptors, count, timeout, signals);
}

/// Linux writes what is left of the time back.
BARAKA_EXPORTED int select(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                           fd_set* __restrict exceptional, timeval* __restrict timeout) {
  if (!gateway::dilate::is_time(timeout)) {
    return BARAKA_NEXT(select)(count, readable, writable, exceptional, timeout);
  }
  const auto& dilation = gateway::dilate::ProcessTime::get().dilation();
  timeval kernel =
      gateway::dilate::to_timeval_up(dilation.to_kernel(gateway::dilate::nanoseconds(*timeout)));
  const int ready = BARAKA_NEXT(select)(count, readable, writable, exceptional, &kernel);
  *timeout = gateway::dilate::for_program(kernel);
  return ready;
}

// POSIX gives it six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED int pselect(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                            fd_set* __restrict exceptional, const timespec* __restrict timeout,
                            const sigset_t* __restrict signals) {
  const auto kernel = ForKernel::duration(timeout);
  return BARAKA_NEXT(pselect)(count, readable, writable, exceptional, kernel.get(), signals);
}

BARAKA_EXPORTED int epoll_wait(int epoll, epoll_event* events, int most, int timeout) {
  return BARAKA_NEXT(epoll_wait)(epoll, events, most, milliseconds_for_kernel(timeout));
}

BARAKA_EXPORTED int epoll_pwait(int epoll, epoll_event* events, int most, int timeout,
                                const sigset_t* signals) {
  return BARAKA_NEXT(epoll_pwait)(epoll, events, most, milliseconds_for_kernel(timeout), signals);
}

BARAKA_EXPORTED int epoll_pwait2(int epoll, epoll_event* events, int most, const timespec* timeout,
                                 const sigset_t* signals) {
  const auto kernel = ForKernel::duration(timeout);
  return BARAKA_NEXT(epoll_pwait2)(epoll, events, most, kernel.get(), signals);
}

BARAKA_EXPORTED int sigtimedwait(const sigset_t* __restrict signals, siginfo_t* __restrict info,
                                 const timespec* __restrict timeout) {
  const auto kernel = ForKernel::duration(timeout);
  return BARAKA_NEXT(sigtimedwait)(signals, info, kernel.get());
}
