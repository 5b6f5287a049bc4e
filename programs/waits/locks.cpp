// Waits of threads for each other: POSIX.1-2017, <pthread.h>, <semaphore.h>; C11, 7.26.3 and
// 7.26.4; and those of the GNU C library that name a clock.
//
// The C library's own objects stay as they are; whether one can be had now, they are asked by calls
// that do not wait. Who has to wait is parked, and whoever gives something back wakes one of those.
#include <pthread.h>
#include <semaphore.h>
#include <sys/syscall.h>
#include <threads.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/handlers.h"
#include "programs/waits/parking.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::count_look;
using programs::waits::deadline_at;
using programs::waits::kNever;
using programs::waits::Nanoseconds;
using programs::waits::object_at;
using programs::waits::own_slot;
using programs::waits::park;
using programs::waits::wake;
using programs::waits::Woken;

constexpr unsigned kAll = ~0U;

// Of the GNU C library, since 2.25 or earlier: no call tells whether processes share an object.
bool is_shared(const pthread_mutex_t& mutex) {
  constexpr int kShared = 128;  // nptl/pthreadP.h: PTHREAD_MUTEX_PSHARED_BIT
  return (mutex.__data.__kind & kShared) != 0;
}
bool is_shared(const pthread_rwlock_t& lock) { return lock.__data.__shared != 0; }
bool is_shared(const pthread_cond_t& condition) {
  constexpr unsigned kShared = 1;  // nptl/pthread_cond_common.c
  return (condition.__data.__wrefs & kShared) != 0;
}
bool is_shared(const sem_t& semaphore) {
  // internaltypes.h: struct new_sem, whose third word is `private`.
  return reinterpret_cast<const std::array<unsigned, 4>*>(&semaphore)->at(2) != 0;
}

template <class Object>
std::uint64_t object_of(const Object& object) {
  return is_shared(object) ? programs::waits::kSharedObject : object_at(&object);
}

/// After something was given back. Those that wait for a shared one all look again.
template <class Object>
void wake_one(const Object& object) {
  if (own_slot() == nullptr) return;
  is_shared(object) ? wake(programs::waits::kSharedObject, kAll) : wake(object_at(&object), 1);
}
template <class Object>
void wake_all(const Object& object) {
  if (own_slot() != nullptr) wake(object_of(object), kAll);
}

/// Tries until it is not EBUSY. @return what the last try gave, or ETIMEDOUT.
template <class Object, class Try>
int lock_until(Object* object, Nanoseconds deadline, const Try& attempt) {
  for (;;) {
    const int error = attempt(object);
    if (error != EBUSY) return error;
    if (park(object_of(*object), deadline) == Woken::kByDeadline) {
      const int last = attempt(object);
      return last == EBUSY ? ETIMEDOUT : last;
    }
  }
}

/// A mutex that says so when its owner locks it again.
bool would_say_deadlock(const pthread_mutex_t& mutex) {
  constexpr int kKinds = 3;
  return (mutex.__data.__kind & kKinds) == PTHREAD_MUTEX_ERRORCHECK &&
         mutex.__data.__owner == static_cast<int>(BARAKA_NEXT_QUIET(syscall)(SYS_gettid));
}

/// A thread that takes a mutex and returns it, again and again, until another thread has changed
/// something: Fast DDS's that sends does so while it cannot have its writer's mutex. The other one
/// gets its turn only when this one waits, so many mutexes are as one look at the clock.
void count_lock() {
  constexpr unsigned kAsOneLook = 16;
  __attribute__((tls_model("initial-exec"))) thread_local unsigned locks = 0;
  if (++locks % kAsOneLook != 0) return;
  const int kept = errno;
  count_look(1);
  errno = kept;
}

int lock_mutex(pthread_mutex_t* mutex, Nanoseconds deadline) {
  if (would_say_deadlock(*mutex)) return EDEADLK;
  count_lock();
  return lock_until(mutex, deadline, BARAKA_NEXT_QUIET(pthread_mutex_trylock));
}

/// By which its timed waits go: bit 1 of this field (nptl/pthread_cond_common.c).
clockid_t clock_of(const pthread_cond_t& condition) {
  constexpr unsigned kMonotonic = 2;
  return (condition.__data.__wrefs & kMonotonic) != 0 ? CLOCK_MONOTONIC : CLOCK_REALTIME;
}

int wait_for_condition(pthread_cond_t* condition, pthread_mutex_t* mutex, Nanoseconds deadline) {
  programs::waits::cancellation_point();
  const int error = pthread_mutex_unlock(mutex);
  if (error != 0) return error;
  const Woken woken = park(object_of(*condition), deadline);
  const int locked = pthread_mutex_lock(mutex);
  if (locked != 0) return locked;
  if (woken == Woken::kBySignal) programs::waits::cancellation_point();
  return woken == Woken::kByDeadline ? ETIMEDOUT : 0;
}

int wait_for_semaphore(sem_t* semaphore, Nanoseconds deadline) {
  programs::waits::cancellation_point();
  const unsigned before = programs::waits::interruptions();
  for (;;) {
    if (BARAKA_NEXT_QUIET(sem_trywait)(semaphore) == 0) return 0;
    if (errno != EAGAIN) return -1;
    switch (park(object_of(*semaphore), deadline)) {
      case Woken::kByThread:
        break;
      case Woken::kByDeadline:
        if (BARAKA_NEXT_QUIET(sem_trywait)(semaphore) == 0) return 0;
        errno = ETIMEDOUT;
        return -1;
      case Woken::kBySignal:
        programs::waits::cancellation_point();
        if (deadline == kNever && programs::waits::interruptions() == before) break;
        errno = EINTR;
        return -1;
    }
  }
}

bool is_moment(const timespec* until) { return programs::waits::is_time(until); }

/// As C11's functions say it.
int as_c11(int error) {
  switch (error) {
    case 0:
      return thrd_success;
    case EBUSY:
      return thrd_busy;
    case ETIMEDOUT:
      return thrd_timedout;
    default:
      return thrd_error;
  }
}

pthread_mutex_t* mutex_of(mtx_t* mutex) { return reinterpret_cast<pthread_mutex_t*>(mutex); }
pthread_cond_t* condition_of(cnd_t* condition) {
  return reinterpret_cast<pthread_cond_t*>(condition);
}

}  // namespace

BARAKA_EXPORTED int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_mutex_lock)(mutex);
  return lock_mutex(mutex, kNever);
}

BARAKA_EXPORTED int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                            const timespec* until) noexcept {
  if (own_slot() == nullptr || !is_moment(until)) {
    return BARAKA_NEXT(pthread_mutex_clocklock)(mutex, clock, until);
  }
  return lock_mutex(mutex, deadline_at(until, clock));
}

BARAKA_EXPORTED int pthread_mutex_timedlock(pthread_mutex_t* mutex,
                                            const timespec* until) noexcept {
  return pthread_mutex_clocklock(mutex, CLOCK_REALTIME, until);
}

BARAKA_EXPORTED int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  const int error = BARAKA_NEXT_QUIET(pthread_mutex_unlock)(mutex);
  if (error == 0) wake_one(*mutex);
  return error;
}

BARAKA_EXPORTED int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_rwlock_rdlock)(lock);
  return lock_until(lock, kNever, BARAKA_NEXT_QUIET(pthread_rwlock_tryrdlock));
}

BARAKA_EXPORTED int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_rwlock_wrlock)(lock);
  return lock_until(lock, kNever, BARAKA_NEXT_QUIET(pthread_rwlock_trywrlock));
}

BARAKA_EXPORTED int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock,
                                               const timespec* until) noexcept {
  if (own_slot() == nullptr || !is_moment(until)) {
    return BARAKA_NEXT(pthread_rwlock_clockrdlock)(lock, clock, until);
  }
  return lock_until(lock, deadline_at(until, clock), BARAKA_NEXT_QUIET(pthread_rwlock_tryrdlock));
}

BARAKA_EXPORTED int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock,
                                               const timespec* until) noexcept {
  if (own_slot() == nullptr || !is_moment(until)) {
    return BARAKA_NEXT(pthread_rwlock_clockwrlock)(lock, clock, until);
  }
  return lock_until(lock, deadline_at(until, clock), BARAKA_NEXT_QUIET(pthread_rwlock_trywrlock));
}

BARAKA_EXPORTED int pthread_rwlock_timedrdlock(pthread_rwlock_t* lock,
                                               const timespec* until) noexcept {
  return pthread_rwlock_clockrdlock(lock, CLOCK_REALTIME, until);
}

BARAKA_EXPORTED int pthread_rwlock_timedwrlock(pthread_rwlock_t* lock,
                                               const timespec* until) noexcept {
  return pthread_rwlock_clockwrlock(lock, CLOCK_REALTIME, until);
}

/// All that wait look again: several readers may get it.
BARAKA_EXPORTED int pthread_rwlock_unlock(pthread_rwlock_t* lock) noexcept {
  const int error = BARAKA_NEXT_QUIET(pthread_rwlock_unlock)(lock);
  if (error == 0) wake_all(*lock);
  return error;
}

BARAKA_EXPORTED int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_cond_wait)(condition, mutex);
  return wait_for_condition(condition, mutex, kNever);
}

BARAKA_EXPORTED int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                           clockid_t clock, const timespec* until) {
  if (own_slot() == nullptr || !is_moment(until)) {
    return BARAKA_NEXT(pthread_cond_clockwait)(condition, mutex, clock, until);
  }
  return wait_for_condition(condition, mutex, deadline_at(until, clock));
}

BARAKA_EXPORTED int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                           const timespec* until) {
  return pthread_cond_clockwait(condition, mutex, clock_of(*condition), until);
}

BARAKA_EXPORTED int pthread_cond_signal(pthread_cond_t* condition) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_cond_signal)(condition);
  wake_one(*condition);
  return 0;
}

BARAKA_EXPORTED int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(pthread_cond_broadcast)(condition);
  wake_all(*condition);
  return 0;
}

BARAKA_EXPORTED int sem_wait(sem_t* semaphore) {
  if (own_slot() == nullptr) return BARAKA_NEXT(sem_wait)(semaphore);
  return wait_for_semaphore(semaphore, kNever);
}

BARAKA_EXPORTED int sem_clockwait(sem_t* __restrict semaphore, clockid_t clock,
                                  const timespec* __restrict until) {
  if (own_slot() == nullptr || !is_moment(until)) {
    return BARAKA_NEXT(sem_clockwait)(semaphore, clock, until);
  }
  return wait_for_semaphore(semaphore, deadline_at(until, clock));
}

BARAKA_EXPORTED int sem_timedwait(sem_t* __restrict semaphore, const timespec* __restrict until) {
  return sem_clockwait(semaphore, CLOCK_REALTIME, until);
}

BARAKA_EXPORTED int sem_post(sem_t* semaphore) noexcept {
  const int status = BARAKA_NEXT_QUIET(sem_post)(semaphore);
  if (status == 0) wake_one(*semaphore);
  return status;
}

// C11's are POSIX's in the GNU C library (sysdeps/nptl, thrd_priv.h).
BARAKA_EXPORTED int mtx_lock(mtx_t* mutex) { return as_c11(pthread_mutex_lock(mutex_of(mutex))); }
BARAKA_EXPORTED int mtx_unlock(mtx_t* mutex) {
  return as_c11(pthread_mutex_unlock(mutex_of(mutex)));
}
BARAKA_EXPORTED int mtx_timedlock(mtx_t* __restrict mutex, const timespec* __restrict until) {
  return as_c11(pthread_mutex_timedlock(mutex_of(mutex), until));
}
BARAKA_EXPORTED int cnd_wait(cnd_t* condition, mtx_t* mutex) {
  return as_c11(pthread_cond_wait(condition_of(condition), mutex_of(mutex)));
}
BARAKA_EXPORTED int cnd_timedwait(cnd_t* __restrict condition, mtx_t* __restrict mutex,
                                  const timespec* __restrict until) {
  return as_c11(pthread_cond_timedwait(condition_of(condition), mutex_of(mutex), until));
}
BARAKA_EXPORTED int cnd_signal(cnd_t* condition) {
  return as_c11(pthread_cond_signal(condition_of(condition)));
}
BARAKA_EXPORTED int cnd_broadcast(cnd_t* condition) {
  return as_c11(pthread_cond_broadcast(condition_of(condition)));
}
