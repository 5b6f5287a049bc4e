// Barriers: POSIX.1-2017, <pthread.h>. The object is ours from its initialisation to its end.
#include <pthread.h>

#include <cerrno>
#include <climits>
#include <new>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/parking.h"
#include "programs/waits/turn.h"

namespace {

struct Barrier {
  unsigned count, arrived, round;
  int is_shared;
};
static_assert(sizeof(Barrier) <= sizeof(pthread_barrier_t));

Barrier& ours(pthread_barrier_t* barrier) { return *reinterpret_cast<Barrier*>(barrier); }

}  // namespace

BARAKA_EXPORTED int pthread_barrier_init(pthread_barrier_t* __restrict barrier,
                                         const pthread_barrierattr_t* __restrict attributes,
                                         unsigned count) noexcept {
  if (programs::waits::own_slot() == nullptr) {
    return BARAKA_NEXT(pthread_barrier_init)(barrier, attributes, count);
  }
  if (count == 0 || count > INT_MAX) return EINVAL;
  int is_shared = PTHREAD_PROCESS_PRIVATE;
  if (attributes != nullptr) pthread_barrierattr_getpshared(attributes, &is_shared);
  new (barrier) Barrier{count, 0, 0, is_shared};
  return 0;
}

BARAKA_EXPORTED int pthread_barrier_destroy(pthread_barrier_t* barrier) noexcept {
  if (programs::waits::own_slot() == nullptr) return BARAKA_NEXT(pthread_barrier_destroy)(barrier);
  return ours(barrier).arrived == 0 ? 0 : EBUSY;
}

BARAKA_EXPORTED int pthread_barrier_wait(pthread_barrier_t* barrier) noexcept {
  if (programs::waits::own_slot() == nullptr) return BARAKA_NEXT(pthread_barrier_wait)(barrier);
  Barrier& one = ours(barrier);
  const std::uint64_t object = one.is_shared != PTHREAD_PROCESS_PRIVATE
                                   ? programs::waits::kSharedObject
                                   : programs::waits::object_at(barrier);
  if (++one.arrived == one.count) {
    one.arrived = 0;
    ++one.round;
    programs::waits::wake(object, ~0U);
    return PTHREAD_BARRIER_SERIAL_THREAD;
  }
  const unsigned round = one.round;
  while (one.round == round) programs::waits::park(object, programs::waits::kNever);
  return 0;
}
