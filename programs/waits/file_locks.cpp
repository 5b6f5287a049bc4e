// Locks of files, and descriptors that are closed, which gives locks back: POSIX.1-2017, <fcntl.h>,
// <unistd.h>; flock(2), "Open file description locks" of fcntl(2), close_range(2).
//
// Who waits for a lock is parked, and tries again when a thread of the agent has given one back, a
// descriptor was closed, or a process has ended: the kernel would let those that wait, and the one
// that gave it back, race for it. Another agent's lock is noticed within a second.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/parking.h"
#include "programs/waits/ports.h"
#include "programs/waits/timers.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::kFileLock;
using programs::waits::own_slot;
using programs::waits::Woken;

void wake_for_locks() {
  if (own_slot() != nullptr) programs::waits::wake(kFileLock, ~0U);
}

/// Tries until nobody else has it. @param attempt  does not wait. @return as it.
template <class Try>
int lock_when_free(const Try& attempt) {
  constexpr auto kForOtherAgents = programs::waits::kSecond;
  for (;;) {
    const int status = attempt();
    if (status == 0) wake_for_locks();  // it may have been a smaller one than before
    if (status == 0 || (errno != EAGAIN && errno != EACCES)) return status;
    const auto deadline = programs::waits::deadline_in(kForOtherAgents);
    if (programs::waits::park(kFileLock, deadline) != Woken::kBySignal) continue;
    programs::waits::cancellation_point();
    errno = EINTR;
    return -1;
  }
}

/// What is done to a descriptor that may be the last one of a lock, or stand for a timer.
template <class Call>
int give_back(int descriptor, const Call& call) {
  programs::waits::close_timer(descriptor);
  programs::waits::forget(descriptor);
  const int status = call();
  if (status >= 0) wake_for_locks();
  return status;
}

int control(int descriptor, int command, long argument) {
  return BARAKA_NEXT(fcntl64)(descriptor, command, argument);
}

int control_held(int descriptor, int command, long argument) {
  if (own_slot() == nullptr) return control(descriptor, command, argument);
  switch (command) {
    case F_SETLKW:
      return lock_when_free([=] { return control(descriptor, F_SETLK, argument); });
    case F_OFD_SETLKW:
      return lock_when_free([=] { return control(descriptor, F_OFD_SETLK, argument); });
    case F_SETLK:
    case F_OFD_SETLK: {
      const int status = control(descriptor, command, argument);
      if (status == 0) wake_for_locks();
      return status;
    }
    default:
      return control(descriptor, command, argument);
  }
}

}  // namespace

BARAKA_EXPORTED int flock(int descriptor, int operation) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(flock)(descriptor, operation);
  if ((operation & LOCK_NB) == 0) {
    return lock_when_free([=] { return BARAKA_NEXT(flock)(descriptor, operation | LOCK_NB); });
  }
  const int status = BARAKA_NEXT(flock)(descriptor, operation);
  if (status == 0) wake_for_locks();
  return status;
}

BARAKA_EXPORTED int fcntl(int descriptor, int command, ...) {
  va_list list;
  va_start(list, command);
  const long argument = va_arg(list, long);
  va_end(list);
  return control_held(descriptor, command, argument);
}

BARAKA_EXPORTED int fcntl64(int descriptor, int command, ...) {
  va_list list;
  va_start(list, command);
  const long argument = va_arg(list, long);
  va_end(list);
  return control_held(descriptor, command, argument);
}

BARAKA_EXPORTED int close(int descriptor) {
  return give_back(descriptor, [=] { return BARAKA_NEXT(close)(descriptor); });
}

BARAKA_EXPORTED int dup2(int descriptor, int number) noexcept {
  if (descriptor == number) return BARAKA_NEXT(dup2)(descriptor, number);
  return give_back(number, [=] { return BARAKA_NEXT(dup2)(descriptor, number); });
}

BARAKA_EXPORTED int dup3(int descriptor, int number, int flags) noexcept {
  return give_back(number, [=] { return BARAKA_NEXT(dup3)(descriptor, number, flags); });
}

BARAKA_EXPORTED int close_range(unsigned first, unsigned last, int flags) noexcept {
  const int status = BARAKA_NEXT(close_range)(first, last, flags);
  if (status >= 0) wake_for_locks();
  return status;
}
