// Semaphores and message queues of System V: POSIX.1-2017, <sys/sem.h>, <sys/msg.h>; semtimedop(2).
//
// Who waits for a semaphore or for a message waits in the kernel, where the one that makes it
// possible also does it for those that wait, in their order. Who waits for room in a queue looks
// again when something was taken out of one: the kernel would let all try at once.
#include <sys/ipc.h>
#include <sys/msg.h>
#include <sys/sem.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/parking.h"
#include "programs/waits/signals.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::KernelWait;
using programs::waits::kNever;
using programs::waits::own_slot;
using programs::waits::Woken;

/// Does all of the operations, or none. @return as semop().
int try_operations(int set, const sembuf* operations, std::size_t count) {
  constexpr std::size_t kMost = 500;  // SEMOPM of Linux
  std::array<sembuf, kMost> without_wait;
  if (count > kMost) return BARAKA_NEXT(semop)(set, const_cast<sembuf*>(operations), count);
  std::copy_n(operations, count, without_wait.begin());
  for (std::size_t i = 0; i < count; ++i) without_wait[i].sem_flg |= IPC_NOWAIT;
  return BARAKA_NEXT(semop)(set, without_wait.data(), count);
}

void wake_for_queues() {
  if (own_slot() != nullptr) programs::waits::wake(programs::waits::kQueueRoom, ~0U);
}

}  // namespace

BARAKA_EXPORTED int semtimedop(int set, sembuf* operations, size_t count,
                               const timespec* timeout) noexcept {
  const bool is_valid =
      operations != nullptr && (timeout == nullptr || programs::waits::is_time(timeout));
  if (own_slot() == nullptr || !is_valid)
    return BARAKA_NEXT(semtimedop)(set, operations, count, timeout);
  const int at_once = try_operations(set, operations, count);
  if (at_once >= 0 || errno != EAGAIN) return at_once;
  const programs::waits::OpenToEnd open;
  KernelWait wait(programs::waits::deadline_in(timeout));
  const int status = BARAKA_NEXT(semop)(set, operations, count);
  wait.end();
  if (status < 0 && errno == EINTR && wait.has_expired()) errno = EAGAIN;
  return status;
}

BARAKA_EXPORTED int semop(int set, sembuf* operations, size_t count) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(semop)(set, operations, count);
  return semtimedop(set, operations, count, nullptr);
}

BARAKA_EXPORTED ssize_t msgrcv(int queue, void* message, size_t size, long type, int flags) {
  const auto next = BARAKA_NEXT(msgrcv);
  if (own_slot() == nullptr) return next(queue, message, size, type, flags);
  ssize_t length = next(queue, message, size, type, flags | IPC_NOWAIT);
  if (length < 0 && errno == ENOMSG && (flags & IPC_NOWAIT) == 0) {
    KernelWait wait(kNever);
    length = next(queue, message, size, type, flags);
    wait.end();
    if (length < 0) programs::waits::cancellation_point();
  }
  if (length >= 0) wake_for_queues();
  return length;
}

BARAKA_EXPORTED int msgsnd(int queue, const void* message, size_t size, int flags) {
  const auto next = BARAKA_NEXT(msgsnd);
  if (own_slot() == nullptr) return next(queue, message, size, flags);
  for (;;) {
    const int status = next(queue, message, size, flags | IPC_NOWAIT);
    if (status == 0 || errno != EAGAIN || (flags & IPC_NOWAIT) != 0) return status;
    if (programs::waits::park(programs::waits::kQueueRoom, kNever) != Woken::kBySignal) continue;
    programs::waits::cancellation_point();
    errno = EINTR;
    return -1;
  }
}

/// It may be removed, or made larger.
BARAKA_EXPORTED int msgctl(int queue, int command, msqid_ds* state) noexcept {
  const int status = BARAKA_NEXT(msgctl)(queue, command, state);
  if (status >= 0) wake_for_queues();
  return status;
}
