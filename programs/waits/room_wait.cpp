// Waits for room in the queue of the station, in virtual time: see programs/preload/room.h.
#include <cerrno>

#include "programs/preload/room.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/parking.h"
#include "programs/waits/virtual_clock.h"

namespace programs::preload {

int wait_for_room(std::uint32_t seen, Nanoseconds longest) {
  if (room()->change().load() != seen) return 0;
  const auto deadline = longest < 0 ? waits::kNever : waits::deadline_in(longest);
  switch (waits::park(waits::kRoom, deadline)) {
    case waits::Woken::kByThread:
      return 0;
    case waits::Woken::kByDeadline:
      return ETIMEDOUT;
    case waits::Woken::kBySignal:
      break;
  }
  return EINTR;
}

void wake_for_room() { waits::wake(waits::kRoom, ~0U); }

Nanoseconds send_timeout(int socket) {
  const Nanoseconds deadline = waits::send_deadline(socket);
  return deadline == waits::kNever ? -1 : deadline - waits::now();
}

Nanoseconds time_of_waits() { return waits::now(); }

}  // namespace programs::preload
