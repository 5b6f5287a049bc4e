// Threads: POSIX.1-2017, <pthread.h>; C11, 7.26.5.
#include <pthread.h>
#include <threads.h>

#include <cerrno>
#include <cstdlib>
#include <new>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/parking.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::adopt;
using programs::waits::own_slot;
using programs::waits::WaitSlot;

/// What a new thread is to do, once it is its turn.
struct Start {
  void* (*function)(void*);
  void* argument;
  WaitSlot* slot;
};

/// Before its turn a thread runs beside the one that made it, and its system calls are not caught:
/// who then waited for a lock of the C library that it holds, as malloc()'s, would not be woken.
void* begin(void* given) {
  const Start start = *static_cast<Start*>(given);
  adopt(*start.slot);
  std::free(given);
  return start.function(start.argument);
}

struct StartOfC11 {
  thrd_start_t function;
  void* argument;
};

void* begin_c11(void* given) {
  const StartOfC11 start = *static_cast<StartOfC11*>(given);
  std::free(given);
  const std::intptr_t result = start.function(start.argument);
  return reinterpret_cast<void*>(result);  // NOLINT(performance-no-int-to-ptr)
}

/// Waits until a thread is about to end; then the kernel need only be waited for. A handler that
/// runs meanwhile may keep this thread from hearing of the end, so it looks again.
int join_until(pthread_t thread, void** result, programs::waits::Nanoseconds deadline) {
  for (;;) {
    const int error = BARAKA_NEXT(pthread_tryjoin_np)(thread, result);
    if (error != EBUSY) return error;
    if (programs::waits::is_ending(thread)) return BARAKA_NEXT(pthread_join)(thread, result);
    programs::waits::cancellation_point();
    const auto woken = programs::waits::park(programs::waits::object_of(thread), deadline);
    if (woken != programs::waits::Woken::kByDeadline) continue;
    if (deadline != programs::waits::kNever) return ETIMEDOUT;
    return BARAKA_NEXT(pthread_join)(thread, result);  // the run is over
  }
}

}  // namespace

BARAKA_EXPORTED int pthread_create(pthread_t* __restrict thread,
                                   const pthread_attr_t* __restrict attributes,
                                   void* (*function)(void*), void* __restrict argument) noexcept {
  const auto next = BARAKA_NEXT(pthread_create);
  if (own_slot() == nullptr) return next(thread, attributes, function, argument);
  void* const memory = std::malloc(sizeof(Start));
  if (memory == nullptr) return EAGAIN;
  WaitSlot& slot = programs::waits::expect_one();
  auto* const start = new (memory) Start{function, argument, &slot};
  const int error = next(thread, attributes, begin, start);
  if (error == 0) return 0;
  std::free(memory);
  programs::waits::give_back_slot(slot);
  return error;
}

BARAKA_EXPORTED int pthread_join(pthread_t thread, void** result) {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_join)(thread, result);
  return join_until(thread, result, programs::waits::kNever);
}

BARAKA_EXPORTED int pthread_clockjoin_np(pthread_t thread, void** result, clockid_t clock,
                                         const timespec* until) {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_clockjoin_np)(thread, result, clock, until);
  return join_until(thread, result, programs::waits::deadline_at(until, clock));
}

BARAKA_EXPORTED int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* until) {
  return pthread_clockjoin_np(thread, result, CLOCK_REALTIME, until);
}

BARAKA_EXPORTED int thrd_create(thrd_t* thread, thrd_start_t function, void* argument) {
  if (own_slot() == nullptr) return BARAKA_NEXT(thrd_create)(thread, function, argument);
  void* const memory = std::malloc(sizeof(StartOfC11));
  if (memory == nullptr) return thrd_nomem;
  auto* const start = new (memory) StartOfC11{function, argument};
  const int error = pthread_create(thread, nullptr, begin_c11, start);
  if (error == 0) return thrd_success;
  std::free(memory);
  return error == ENOMEM || error == EAGAIN ? thrd_nomem : thrd_error;
}

BARAKA_EXPORTED int thrd_join(thrd_t thread, int* result) {
  void* ended_with = nullptr;
  if (pthread_join(thread, &ended_with) != 0) return thrd_error;
  if (result != nullptr) *result = static_cast<int>(reinterpret_cast<std::intptr_t>(ended_with));
  return thrd_success;
}
