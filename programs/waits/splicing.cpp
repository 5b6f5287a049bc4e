// What moves bytes between descriptors: splice(2), tee(2), vmsplice(2), sendfile(2).
#include <fcntl.h>
#include <poll.h>
#include <sys/sendfile.h>
#include <sys/uio.h>

#include <cerrno>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/non_blocking.h"

namespace {

using programs::waits::is_blocking;
using programs::waits::kNever;
using programs::waits::NonBlocking;
using programs::waits::own_slot;
using programs::waits::wait_for_descriptors;

bool wait_for(int descriptor, short events) {
  pollfd one{descriptor, events, 0};
  return wait_for_descriptors(&one, 1, kNever, nullptr) > 0;
}

/// Calls what does not wait until it says something else than EAGAIN; in between it waits for the
/// first to be readable and the second to be writable. @param from, to  -1: none.
template <class Call>
auto until_moved(int from, int to, const Call& call) -> decltype(call()) {
  for (;;) {
    const auto moved = call();
    if (moved >= 0 || errno != EAGAIN) return moved;
    if (from >= 0 && !wait_for(from, POLLIN)) return -1;
    if (to >= 0 && !wait_for(to, POLLOUT)) return -1;
  }
}

bool waits(int descriptor, unsigned flags) {
  return own_slot() != nullptr && (flags & SPLICE_F_NONBLOCK) == 0 && is_blocking(descriptor, 0);
}

}  // namespace

// Linux gives it six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED ssize_t splice(int from, off64_t* from_place, int to, off64_t* to_place,
                               size_t length, unsigned flags) {
  const auto next = BARAKA_NEXT(splice);
  const bool waits_to_read = waits(from, flags), waits_to_write = waits(to, flags);
  if (!waits_to_read && !waits_to_write) return next(from, from_place, to, to_place, length, flags);
  return until_moved(waits_to_read ? from : -1, waits_to_write ? to : -1, [=] {
    const NonBlocking source(from), target(to);
    return next(from, from_place, to, to_place, length, flags | SPLICE_F_NONBLOCK);
  });
}

BARAKA_EXPORTED ssize_t tee(int from, int to, size_t length, unsigned flags) {
  const auto next = BARAKA_NEXT(tee);
  const bool waits_to_read = waits(from, flags), waits_to_write = waits(to, flags);
  if (!waits_to_read && !waits_to_write) return next(from, to, length, flags);
  return until_moved(waits_to_read ? from : -1, waits_to_write ? to : -1,
                     [=] { return next(from, to, length, flags | SPLICE_F_NONBLOCK); });
}

/// To a pipe, or from one.
BARAKA_EXPORTED ssize_t vmsplice(int pipe, const iovec* parts, size_t count, unsigned flags) {
  const auto next = BARAKA_NEXT(vmsplice);
  if (!waits(pipe, flags)) return next(pipe, parts, count, flags);
  const bool writes = (fcntl(pipe, F_GETFL) & O_ACCMODE) != O_RDONLY;
  return until_moved(writes ? -1 : pipe, writes ? pipe : -1,
                     [=] { return next(pipe, parts, count, flags | SPLICE_F_NONBLOCK); });
}

/// Goes on until all of it is sent, as the kernel does where it may wait.
BARAKA_EXPORTED ssize_t sendfile64(int to, int from, off64_t* place, size_t length) noexcept {
  const auto next = BARAKA_NEXT(sendfile64);
  if (!waits(to, 0)) return next(to, from, place, length);
  std::size_t sent = 0;
  while (sent < length) {
    const ssize_t some = until_moved(-1, to, [&] {
      const NonBlocking target(to);
      return next(to, from, place, length - sent);
    });
    if (some < 0 && sent == 0) return -1;
    if (some <= 0) break;
    sent += static_cast<std::size_t>(some);
  }
  return static_cast<ssize_t>(sent);
}

BARAKA_EXPORTED ssize_t sendfile(int to, int from, off_t* place, size_t length) noexcept {
  return sendfile64(to, from, place, length);
}
