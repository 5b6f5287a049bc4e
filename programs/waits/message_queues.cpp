// POSIX.1-2017, <mqueue.h>. A queue is a descriptor of Linux (mq_overview(7)): who waits for a
// message, or for room for one, waits for it to be ready.
#include <mqueue.h>
#include <poll.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/signals.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::deadline_at;
using programs::waits::own_slot;

/// A time that has passed: the call does not wait, and says ETIMEDOUT where it would have.
constexpr timespec kPast{0, 0};

template <class Call>
auto until_possible(mqd_t queue, short events, const timespec* until, const Call& call)
    -> decltype(call(until)) {
  if (own_slot() == nullptr) return call(until);
  if (until != nullptr && !programs::waits::is_time(until)) return call(until);
  for (;;) {
    const auto result = call(&kPast);
    if (result >= 0 || errno != ETIMEDOUT) return result;
    pollfd one{queue, events, 0};
    const int ready =
        programs::waits::wait_for_descriptors(&one, 1, deadline_at(until, CLOCK_REALTIME), nullptr);
    if (ready > 0) continue;
    if (ready == 0) errno = ETIMEDOUT;
    return -1;
  }
}

/// The kernel may send a signal that somebody has asked for.
int send(mqd_t queue, const char* message, size_t size, unsigned priority, const timespec* until) {
  const int status = until_possible(queue, POLLOUT, until, [=](const timespec* limit) {
    return limit == nullptr ? BARAKA_NEXT(mq_send)(queue, message, size, priority)
                            : BARAKA_NEXT(mq_timedsend)(queue, message, size, priority, limit);
  });
  return static_cast<int>(programs::waits::told(status));
}

ssize_t receive(mqd_t queue, char* message, size_t size, unsigned* priority,
                const timespec* until) {
  return until_possible(queue, POLLIN, until, [=](const timespec* limit) {
    return limit == nullptr ? BARAKA_NEXT(mq_receive)(queue, message, size, priority)
                            : BARAKA_NEXT(mq_timedreceive)(queue, message, size, priority, limit);
  });
}

}  // namespace

BARAKA_EXPORTED int mq_timedsend(mqd_t queue, const char* message, size_t size, unsigned priority,
                                 const timespec* until) {
  return send(queue, message, size, priority, until);
}

BARAKA_EXPORTED int mq_send(mqd_t queue, const char* message, size_t size, unsigned priority) {
  return send(queue, message, size, priority, nullptr);
}

BARAKA_EXPORTED ssize_t mq_timedreceive(mqd_t queue, char* __restrict message, size_t size,
                                        unsigned* __restrict priority,
                                        const timespec* __restrict until) {
  return receive(queue, message, size, priority, until);
}

BARAKA_EXPORTED ssize_t mq_receive(mqd_t queue, char* message, size_t size, unsigned* priority) {
  return receive(queue, message, size, priority, nullptr);
}

/// The C library would wait for it in a thread that the run does not know.
BARAKA_EXPORTED int mq_notify(mqd_t queue, const sigevent* event) noexcept {
  const bool is_refused =
      own_slot() != nullptr && event != nullptr && event->sigev_notify == SIGEV_THREAD;
  if (!is_refused) return BARAKA_NEXT(mq_notify)(queue, event);
  std::fprintf(stderr, "baraka: mq_notify() with SIGEV_THREAD is not available in lock-step\n");
  errno = ENOSYS;
  return -1;
}
