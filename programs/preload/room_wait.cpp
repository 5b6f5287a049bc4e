// How a thread waits for room where time follows the wall clock: see room.h.
#include <linux/futex.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>

#include "programs/preload/converted.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/room.h"

namespace programs::preload {
namespace {

/// Counts this thread among those to be woken.
class Waiting {
 public:
  Waiting() { room()->waiting().fetch_add(1); }
  ~Waiting() { room()->waiting().fetch_sub(1); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
};

}  // namespace

int wait_for_room(std::uint32_t seen, Nanoseconds longest) {
  const timespec time = to_timespec(longest);
  // If room was made since `seen`, the futex is another one and does not wait.
  const Waiting waiting;
  const long status = BARAKA_NEXT(syscall)(SYS_futex, &room()->change(), FUTEX_WAIT, seen,
                                           longest < 0 ? nullptr : &time, nullptr, 0);
  return status == 0 || errno == EAGAIN ? 0 : errno;
}

void wake_for_room() {
  if (room()->waiting().load() == 0) return;
  BARAKA_NEXT(syscall)(SYS_futex, &room()->change(), FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

Nanoseconds send_timeout(int socket) {
  timeval timeout{};
  socklen_t length = sizeof timeout;
  if (BARAKA_NEXT(getsockopt)(socket, SOL_SOCKET, SO_SNDTIMEO, &timeout, &length) != 0) return -1;
  const Nanoseconds time = nanoseconds(timeout);
  return time == 0 ? -1 : time;
}

Nanoseconds time_of_waits() { return kernel_time(CLOCK_MONOTONIC); }

}  // namespace programs::preload
