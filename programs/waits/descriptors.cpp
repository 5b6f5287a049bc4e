// Waits for descriptors: POSIX.1-2017, <poll.h>, <sys/select.h>; epoll(7). Each is one ppoll() or
// pselect() of the kernel without a time-out, which the run ends.
#include "programs/waits/descriptors.h"

#include <fcntl.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#include "programs/preload/descriptor_sets.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/writable.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/handlers.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/virtual_clock.h"

extern "C" {
/// What the GNU C library's headers call in place of poll() and ppoll() when they know how large
/// the array is (_FORTIFY_SOURCE).
int checked_poll(pollfd* descriptors, nfds_t count, int timeout,
                 std::size_t size) __asm__("__poll_chk");
int checked_ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                  const sigset_t* signals, std::size_t size) __asm__("__ppoll_chk");
[[noreturn]] void fail_check() __asm__("__chk_fail");
}

namespace programs::waits {
namespace {

constexpr timespec kNoTime{0, 0}, kLastStep{0, 1'000'000};
/// While a socket that is to be writable has no room in its station's queue, the others are looked
/// at as often.
constexpr Nanoseconds kLookForRoom = 1'000'000;

bool is_to_send(const pollfd* descriptors, nfds_t count) {
  return std::any_of(descriptors, descriptors + count,
                     [](const pollfd& one) { return (one.events & POLLOUT) != 0; });
}

/// What is ready now, without sockets that have no room. @return as ppoll().
int look(pollfd* descriptors, nfds_t count, bool& lacks_room) {
  const int ready = BARAKA_NEXT_QUIET(ppoll)(descriptors, count, &kNoTime, nullptr);
  lacks_room = ready > 0 && preload::room() != nullptr && preload::wants_room(descriptors, count) &&
               !preload::room()->has_room(1);
  return lacks_room ? preload::ready_without_room(descriptors, count) : ready;
}

/// By a handler, whatever the kernel said of it: what woke the thread before may have been taken by
/// another since, and whether the thread has seen it depends on the computer.
int interrupted() {
  errno = EINTR;
  return -1;
}

}  // namespace

sigset_t blocked_in_wait(const sigset_t* signals) {
  sigset_t blocked{};
  if (signals != nullptr) {
    blocked = *signals;
  } else {
    // The C library's call would be caught.
    constexpr long kKernelSize = 8;
    kernel_call(SYS_rt_sigprocmask,
                {SIG_BLOCK, 0, reinterpret_cast<long>(&blocked), kKernelSize, 0, 0});
  }
  sigdelset(&blocked, kEndWait);
  return blocked;
}

bool is_blocking(int descriptor, int flags) {
  return (flags & MSG_DONTWAIT) == 0 &&
         (BARAKA_NEXT_QUIET(fcntl64)(descriptor, F_GETFL) & O_NONBLOCK) == 0;
}

int wait_to_transfer(int descriptor, short events, Nanoseconds deadline) {
  pollfd one{descriptor, events, 0};
  for (;;) {
    const unsigned before = interruptions();
    const int ready = wait_for_descriptors(&one, 1, deadline, nullptr);
    const bool goes_on = ready < 0 && errno == EINTR && deadline == kNever && !is_over();
    if (!goes_on || interruptions() != before) return ready;
  }
}

namespace {

/// @return false: with errno, what the call ends with.
bool wait_once(pollfd* descriptors, nfds_t count, Nanoseconds deadline, const sigset_t& blocked) {
  KernelWait wait(deadline, is_to_send(descriptors, count) ? netns::kSendingObject : 0);
  const int status = BARAKA_NEXT_QUIET(ppoll)(descriptors, count, nullptr, &blocked);
  wait.end();
  return status >= 0 || errno == EINTR;
}

}  // namespace

int wait_for_descriptors(pollfd* descriptors, nfds_t count, Nanoseconds deadline,
                         const sigset_t* signals) {
  cancellation_point();
  const unsigned handled = handlers_run();
  for (;;) {
    bool lacks_room = false;
    const int ready = look(descriptors, count, lacks_room);
    if (ready != 0) return ready;
    if (deadline <= now()) {
      count_look(1);
      return 0;
    }
    if (handlers_run() != handled) return interrupted();
    if (lacks_room) {
      sleep_until(std::min(deadline, now() + kLookForRoom));
      continue;
    }
    const sigset_t blocked = blocked_in_wait(signals);
    if (is_over() && deadline != kNever)
      return BARAKA_NEXT(ppoll)(descriptors, count, &kLastStep, &blocked);
    if (!wait_once(descriptors, count, deadline, blocked)) return -1;
    cancellation_point();
  }
}

namespace {

class Selection {
 public:
  Selection(int count, const preload::DescriptorSets& sets)
      : count_(count), sets_(sets), asked_(sets, count) {}

  int wait(Nanoseconds deadline, const sigset_t* signals) {
    cancellation_point();
    const unsigned handled = handlers_run();
    for (;;) {
      bool lacks_room = false;
      const int ready = look(lacks_room);
      if (ready != 0) return ready;
      if (deadline <= now()) {
        asked_.clear(sets_);
        count_look(1);
        return 0;
      }
      if (handlers_run() != handled) return interrupted();
      if (lacks_room) {
        sleep_until(std::min(deadline, now() + kLookForRoom));
        continue;
      }
      if (!wait_in_kernel(deadline, signals)) return -1;
      if (is_over() && deadline != kNever) return 0;
    }
  }

 private:
  int look(bool& lacks_room) {
    asked_.restore(sets_);
    const int ready = select_now(&kNoTime, nullptr);
    lacks_room = ready > 0 && preload::room() != nullptr &&
                 preload::wants_room(count_, sets_.writable) && !preload::room()->has_room(1);
    if (!lacks_room) return ready;
    preload::clear_without_room(count_, *sets_.writable);
    return preload::members(count_, {sets_.readable, sets_.writable, sets_.exceptional});
  }

  bool wait_in_kernel(Nanoseconds deadline, const sigset_t* signals) {
    asked_.restore(sets_);
    const sigset_t blocked = blocked_in_wait(signals);
    if (is_over() && deadline != kNever) {
      asked_.clear(sets_);
      return BARAKA_NEXT(ppoll)(nullptr, 0, &kLastStep, &blocked) == 0;
    }
    KernelWait wait(deadline, sets_.writable != nullptr ? netns::kSendingObject : 0);
    const int status = select_now(nullptr, &blocked);
    wait.end();
    if (status < 0 && errno != EINTR) return false;
    cancellation_point();
    return true;
  }

  int select_now(const timespec* timeout, const sigset_t* signals) {
    return BARAKA_NEXT_QUIET(pselect)(count_, sets_.readable, sets_.writable, sets_.exceptional,
                                      timeout, signals);
  }
  int count_;
  preload::DescriptorSets sets_;
  preload::AskedSets asked_;
};

/// epoll(7) by the readiness of its own descriptor.
int wait_for_epoll(int epoll, epoll_event* events, int most, Nanoseconds deadline,
                   const sigset_t* signals) {
  for (;;) {
    const int ready = BARAKA_NEXT_QUIET(epoll_wait)(epoll, events, most, 0);
    if (ready != 0) return ready;
    // It may be waiting to send as well, of which its descriptor does not tell.
    pollfd one{epoll, POLLIN | POLLOUT, 0};
    const int status = wait_for_descriptors(&one, 1, deadline, signals);
    if (status <= 0) return status;
  }
}

}  // namespace
}  // namespace programs::waits

using programs::waits::deadline_in;
using programs::waits::own_slot;

BARAKA_EXPORTED int poll(pollfd* descriptors, nfds_t count, int timeout) {
  if (own_slot() == nullptr) return BARAKA_NEXT(poll)(descriptors, count, timeout);
  return programs::waits::wait_for_descriptors(
      descriptors, count, programs::waits::deadline_in_milliseconds(timeout), nullptr);
}

BARAKA_EXPORTED int ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                          const sigset_t* signals) {
  const bool is_valid = timeout == nullptr || programs::waits::is_time(timeout);
  if (own_slot() == nullptr || !is_valid) {
    return BARAKA_NEXT(ppoll)(descriptors, count, timeout, signals);
  }
  return programs::waits::wait_for_descriptors(descriptors, count, deadline_in(timeout), signals);
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

// POSIX gives it six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED int pselect(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                            fd_set* __restrict exceptional, const timespec* __restrict timeout,
                            const sigset_t* __restrict signals) {
  const bool is_valid = timeout == nullptr || programs::waits::is_time(timeout);
  if (own_slot() == nullptr || !is_valid) {
    return BARAKA_NEXT(pselect)(count, readable, writable, exceptional, timeout, signals);
  }
  programs::waits::Selection selection(count, {readable, writable, exceptional});
  return selection.wait(deadline_in(timeout), signals);
}

/// Linux writes what is left of the time back.
BARAKA_EXPORTED int select(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                           fd_set* __restrict exceptional, timeval* __restrict timeout) {
  if (own_slot() == nullptr) {
    return BARAKA_NEXT(select)(count, readable, writable, exceptional, timeout);
  }
  programs::waits::Selection selection(count, {readable, writable, exceptional});
  if (timeout == nullptr) return selection.wait(programs::waits::kNever, nullptr);
  const auto deadline =
      deadline_in(timeout->tv_sec * programs::waits::kSecond + timeout->tv_usec * 1000);
  const int ready = selection.wait(deadline, nullptr);
  const int kept = errno;
  const auto left = programs::waits::to_timespec(
      std::max<programs::waits::Nanoseconds>(0, deadline - programs::waits::now()));
  *timeout = {left.tv_sec, left.tv_nsec / 1000};
  errno = kept;
  return ready;
}

BARAKA_EXPORTED int epoll_pwait(int epoll, epoll_event* events, int most, int timeout,
                                const sigset_t* signals) {
  if (own_slot() == nullptr) return BARAKA_NEXT(epoll_pwait)(epoll, events, most, timeout, signals);
  return programs::waits::wait_for_epoll(
      epoll, events, most, programs::waits::deadline_in_milliseconds(timeout), signals);
}

BARAKA_EXPORTED int epoll_wait(int epoll, epoll_event* events, int most, int timeout) {
  return epoll_pwait(epoll, events, most, timeout, nullptr);
}

BARAKA_EXPORTED int epoll_pwait2(int epoll, epoll_event* events, int most, const timespec* timeout,
                                 const sigset_t* signals) {
  const bool is_valid = timeout == nullptr || programs::waits::is_time(timeout);
  if (own_slot() == nullptr || !is_valid) {
    return BARAKA_NEXT(epoll_pwait2)(epoll, events, most, timeout, signals);
  }
  return programs::waits::wait_for_epoll(epoll, events, most, deadline_in(timeout), signals);
}
