#pragma once

#include <poll.h>
#include <sys/select.h>

#include <algorithm>
#include <cerrno>
#include <initializer_list>

#include "programs/preload/converted.h"
#include "programs/preload/room.h"

namespace programs::preload {

/// Whether any of these is a socket that is to be writable and waits for room. epoll(7) is not
/// asked so, for its events name no descriptor: who gets EAGAIN there and waits for EPOLLOUT gets
/// it at once, and tries again and again.
bool wants_room(const pollfd* descriptors, nfds_t count);
bool wants_room(int count, const fd_set* writable);

/// Takes back that those are writable. @return how many are ready for something else.
int ready_without_room(pollfd* descriptors, nfds_t count);

void clear_without_room(int count, fd_set& writable);
/// In all sets together, as select() counts. Null: none.
int members(int count, std::initializer_list<const fd_set*> sets);

/// Looks until something is ready, or there is room for a frame, as poll() waits.
/// @param longest  of the kernel's time; negative: for ever.
/// @param look  asks the kernel, with the time left; null: for ever.
/// @param strip  takes back what is writable; returns how many are ready all the same. What comes
///   ready while there is no room is noticed within a millisecond.
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
