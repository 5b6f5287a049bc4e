#include "programs/waits/inheriting_futex.h"

#include <linux/futex.h>
#include <sys/syscall.h>

#include <atomic>
#include <cerrno>

namespace programs::waits {
namespace {

using Word = std::atomic<std::uint32_t>;

long failed(int error) {
  errno = error;
  return -1;
}

std::uint32_t own_number() { return static_cast<std::uint32_t>(own_slot()->thread.load()); }

std::uint32_t owner_of(std::uint32_t value) { return value & FUTEX_TID_MASK; }

/// Takes it if nobody has it. @return an error; 0: this thread has it.
int take(Word& word) {
  std::uint32_t value = word.load();
  while (owner_of(value) == 0) {
    const std::uint32_t left = value & (FUTEX_WAITERS | FUTEX_OWNER_DIED);
    if (word.compare_exchange_weak(value, own_number() | left)) return 0;
  }
  if (owner_of(value) == own_number()) return EDEADLK;
  const long found = kernel_call(SYS_tkill, {static_cast<long>(owner_of(value)), 0});
  return found == -ESRCH ? ESRCH : EWOULDBLOCK;
}

}  // namespace

long try_inheriting(const Arguments& a) {
  const int error = take(*pointer<Word>(a[0]));
  return error == 0 ? 0 : failed(error);
}

/// Linux goes on after handlers.
long lock_inheriting(const Arguments& a, std::uint64_t object, Nanoseconds deadline) {
  Word& word = *pointer<Word>(a[0]);
  for (bool has_waited = false;; has_waited = true) {
    if (has_waited && owner_of(word.load()) == own_number()) return 0;
    const int error = take(word);
    if (error != EWOULDBLOCK) return error == 0 ? 0 : failed(error);
    word.fetch_or(FUTEX_WAITERS);
    if (park(object, deadline) == Woken::kByDeadline) return failed(ETIMEDOUT);
  }
}

long unlock_inheriting(const Arguments& a, std::uint64_t object, bool is_private) {
  Word& word = *pointer<Word>(a[0]);
  if (owner_of(word.load()) != own_number()) return failed(EPERM);
  const auto next = is_private ? static_cast<std::uint32_t>(first_waiting(object)) : 0;
  word.store(next == 0 ? 0 : next | FUTEX_WAITERS);
  wake(object, is_private ? 1 : ~0U);  // of one that is shared they look who gets it
  return 0;
}

}  // namespace programs::waits
