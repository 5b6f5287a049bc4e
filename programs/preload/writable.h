#pragma once

#include <poll.h>
#include <sys/select.h>

#include <algorithm>
#include <cerrno>
#include <initializer_list>

#include "programs/preload/converted.h"
#include "programs/preload/room.h"

namespace programs::preload {

/// Whether one of these is a socket that should be writable but has no room. This is not available
/// for epoll(7), whose events do not identify a descriptor: a program that gets EAGAIN and waits
/// there for EPOLLOUT gets it at once, and tries again and again.
bool wants_room(const pollfd* descriptors, nfds_t count);
bool wants_room(int count, const fd_set* writable);

/// Marks them as not writable. @return how many are ready for something else.
int ready_without_room(pollfd* descriptors, nfds_t count);

void clear_without_room(int count, fd_set& writable);
/// Number of members of all sets together, as select() counts them. Null: no set.
int members(int count, std::initializer_list<const fd_set*> sets);

/// Waits as poll() does until something is ready, or there is room for a frame.
/// @param longest  of the kernel's time; negative: no limit.
/// @param look  asks the kernel, with the time that is left; null: no limit.
/// @param strip  removes what is writable; returns how many are still ready. What becomes ready
/// while there is no room is noticed within a millisecond.
template <class Look, class Strip>
int until_ready(Nanoseconds longest, const Look& look, const Strip& strip) {
  constexpr Nanoseconds kMillisecond = 1'000'000;
  const Nanoseconds begin = kernel_time(CLOCK_MONOTONIC);
  for (;;) {
    const Nanoseconds passed = kernel_time(CLOCK_MONOTONIC) - begin;
    const Nanoseconds left = std::max<Nanoseconds>(longest - passed, 0);
    const timespec time = to_timespec(left);
    const std::uint32_t seen = room()->change().load();
    const int ready = look(longest < 0 ? nullptr : &time);
    if (ready <= 0 || room()->has_room(1)) return ready;
    const int others = strip();
    if (others > 0 || (longest >= 0 && left == 0)) return others;
    const int error =
        wait_for_room(seen, longest < 0 ? kMillisecond : std::min(left, kMillisecond));
    if (error != EINTR) continue;
    errno = EINTR;
    return -1;
  }
}

}  // namespace programs::preload
