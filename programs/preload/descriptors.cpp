// Waiting for descriptors and signals: POSIX.1-2017, <poll.h>, <sys/select.h>, <signal.h>;
// epoll(7).
#include <poll.h>
#include <sys/epoll.h>
#include <sys/select.h>

#include <csignal>

#include "programs/preload/converted.h"
#include "programs/preload/descriptor_sets.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/writable.h"

using programs::preload::ForKernel;
using programs::preload::milliseconds_for_kernel;

extern "C" {
/// Functions that the GNU C library's headers call in place of poll() and ppoll() if they know the
/// size of the array (_FORTIFY_SOURCE).
int checked_poll(pollfd* descriptors, nfds_t count, int timeout,
                 std::size_t size) __asm__("__poll_chk");
int checked_ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                  const sigset_t* signals, std::size_t size) __asm__("__ppoll_chk");
[[noreturn]] void fail_check() __asm__("__chk_fail");
}

namespace {

bool is_time_or_null(const timespec* time) {
  return time == nullptr || programs::preload::is_time(time);
}

/// Time-out in nanoseconds; negative: none.
programs::preload::Nanoseconds or_for_ever(const timespec* time) {
  return time == nullptr ? -1 : programs::preload::nanoseconds(*time);
}

/// ppoll() for which a socket without room is not writable.
int poll_for_room(pollfd* descriptors, nfds_t count, programs::preload::Nanoseconds longest,
                  const sigset_t* signals) {
  return programs::preload::until_ready(
      longest,
      [=](const timespec* left) { return BARAKA_NEXT(ppoll)(descriptors, count, left, signals); },
      [=] { return programs::preload::ready_without_room(descriptors, count); });
}

/// pselect() for which a socket without room is not writable.
int select_for_room(int count, const programs::preload::DescriptorSets& sets,
                    programs::preload::Nanoseconds longest, const sigset_t* signals) {
  const programs::preload::AskedSets asked(sets, count);
  return programs::preload::until_ready(
      longest,
      [&](const timespec* left) {
        asked.restore(sets);
        return BARAKA_NEXT(pselect)(count, sets.readable, sets.writable, sets.exceptional, left,
                                    signals);
      },
      [&] {
        programs::preload::clear_without_room(count, *sets.writable);
        return programs::preload::members(count, {sets.readable, sets.writable, sets.exceptional});
      });
}

}  // namespace

BARAKA_EXPORTED int poll(pollfd* descriptors, nfds_t count, int timeout) {
  const int kernel = milliseconds_for_kernel(timeout);
  if (programs::preload::wants_room(descriptors, count)) {
    constexpr programs::preload::Nanoseconds kMillisecond = 1'000'000;
    return poll_for_room(descriptors, count, kernel * kMillisecond, nullptr);
  }
  return BARAKA_NEXT(poll)(descriptors, count, kernel);
}

BARAKA_EXPORTED int ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                          const sigset_t* signals) {
  const auto kernel = ForKernel::duration(timeout);
  if (programs::preload::wants_room(descriptors, count) && is_time_or_null(kernel.get())) {
    return poll_for_room(descriptors, count, or_for_ever(kernel.get()), signals);
  }
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

/// Linux writes the remaining time back.
BARAKA_EXPORTED int select(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                           fd_set* __restrict exceptional, timeval* __restrict timeout) {
  const bool waits_for_room = programs::preload::wants_room(count, writable);
  if (timeout == nullptr && waits_for_room) {
    return select_for_room(count, {readable, writable, exceptional}, -1, nullptr);
  }
  if (!programs::preload::is_time(timeout)) {
    return BARAKA_NEXT(select)(count, readable, writable, exceptional, timeout);
  }
  const auto& dilation = programs::preload::ProcessTime::get().dilation();
  const auto longest = dilation.to_kernel(programs::preload::nanoseconds(*timeout));
  if (waits_for_room) {
    const auto begin = programs::preload::kernel_time(CLOCK_MONOTONIC);
    const int ready = select_for_room(count, {readable, writable, exceptional}, longest, nullptr);
    const auto left = longest - (programs::preload::kernel_time(CLOCK_MONOTONIC) - begin);
    *timeout = programs::preload::to_timeval(dilation.to_program(left));
    return ready;
  }
  timeval kernel = programs::preload::to_timeval_up(longest);
  const int ready = BARAKA_NEXT(select)(count, readable, writable, exceptional, &kernel);
  *timeout = programs::preload::for_program(kernel);
  return ready;
}

// POSIX defines six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED int pselect(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                            fd_set* __restrict exceptional, const timespec* __restrict timeout,
                            const sigset_t* __restrict signals) {
  const auto kernel = ForKernel::duration(timeout);
  if (programs::preload::wants_room(count, writable) && is_time_or_null(kernel.get())) {
    return select_for_room(count, {readable, writable, exceptional}, or_for_ever(kernel.get()),
                           signals);
  }
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
