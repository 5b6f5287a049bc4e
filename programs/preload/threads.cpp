// Waiting of threads for each other: POSIX.1-2017, <pthread.h>, <semaphore.h>, <mqueue.h>,
// <sys/sem.h>, <aio.h>; C11, 7.26; and functions of the GNU C library with a clock argument.
#include <aio.h>
#include <mqueue.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/sem.h>
#include <threads.h>

#include "programs/preload/converted.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"

using programs::preload::ForKernel;

namespace {

/// The clock of timed waits for a condition. The GNU C library has it in bit 1 of this field since
/// 2.25 (nptl/pthread_cond_common.c), and no function returns it.
clockid_t clock_of(const pthread_cond_t& condition) {
  constexpr unsigned kMonotonic = 2;
  return (condition.__data.__wrefs & kMonotonic) != 0 ? CLOCK_MONOTONIC : CLOCK_REALTIME;
}

}  // namespace

BARAKA_EXPORTED int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                           const timespec* until) {
  const auto kernel = ForKernel::moment(until, clock_of(*condition));
  return BARAKA_NEXT(pthread_cond_timedwait)(condition, mutex, kernel.get());
}

BARAKA_EXPORTED int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                           clockid_t clock, const timespec* until) {
  const auto kernel = ForKernel::moment(until, clock);
  return BARAKA_NEXT(pthread_cond_clockwait)(condition, mutex, clock, kernel.get());
}

BARAKA_EXPORTED int pthread_mutex_timedlock(pthread_mutex_t* mutex,
                                            const timespec* until) noexcept {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(pthread_mutex_timedlock)(mutex, kernel.get());
}

BARAKA_EXPORTED int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                            const timespec* until) noexcept {
  const auto kernel = ForKernel::moment(until, clock);
  return BARAKA_NEXT(pthread_mutex_clocklock)(mutex, clock, kernel.get());
}

BARAKA_EXPORTED int pthread_rwlock_timedrdlock(pthread_rwlock_t* lock,
                                               const timespec* until) noexcept {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(pthread_rwlock_timedrdlock)(lock, kernel.get());
}

BARAKA_EXPORTED int pthread_rwlock_timedwrlock(pthread_rwlock_t* lock,
                                               const timespec* until) noexcept {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(pthread_rwlock_timedwrlock)(lock, kernel.get());
}

BARAKA_EXPORTED int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock,
                                               const timespec* until) noexcept {
  const auto kernel = ForKernel::moment(until, clock);
  return BARAKA_NEXT(pthread_rwlock_clockrdlock)(lock, clock, kernel.get());
}

BARAKA_EXPORTED int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock,
                                               const timespec* until) noexcept {
  const auto kernel = ForKernel::moment(until, clock);
  return BARAKA_NEXT(pthread_rwlock_clockwrlock)(lock, clock, kernel.get());
}

BARAKA_EXPORTED int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* until) {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(pthread_timedjoin_np)(thread, result, kernel.get());
}

BARAKA_EXPORTED int pthread_clockjoin_np(pthread_t thread, void** result, clockid_t clock,
                                         const timespec* until) {
  const auto kernel = ForKernel::moment(until, clock);
  return BARAKA_NEXT(pthread_clockjoin_np)(thread, result, clock, kernel.get());
}

BARAKA_EXPORTED int sem_timedwait(sem_t* __restrict semaphore, const timespec* __restrict until) {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(sem_timedwait)(semaphore, kernel.get());
}

BARAKA_EXPORTED int sem_clockwait(sem_t* __restrict semaphore, clockid_t clock,
                                  const timespec* __restrict until) {
  const auto kernel = ForKernel::moment(until, clock);
  return BARAKA_NEXT(sem_clockwait)(semaphore, clock, kernel.get());
}

BARAKA_EXPORTED int semtimedop(int semaphores, sembuf* operations, std::size_t count,
                               const timespec* timeout) noexcept {
  const auto kernel = ForKernel::duration(timeout);
  return BARAKA_NEXT(semtimedop)(semaphores, operations, count, kernel.get());
}

BARAKA_EXPORTED int mtx_timedlock(mtx_t* __restrict mutex, const timespec* __restrict until) {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(mtx_timedlock)(mutex, kernel.get());
}

BARAKA_EXPORTED int cnd_timedwait(cnd_t* __restrict condition, mtx_t* __restrict mutex,
                                  const timespec* __restrict until) {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(cnd_timedwait)(condition, mutex, kernel.get());
}

BARAKA_EXPORTED int mq_timedsend(mqd_t queue, const char* message, std::size_t length,
                                 unsigned priority, const timespec* until) {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(mq_timedsend)(queue, message, length, priority, kernel.get());
}

BARAKA_EXPORTED ssize_t mq_timedreceive(mqd_t queue, char* __restrict message, std::size_t length,
                                        unsigned* __restrict priority,
                                        const timespec* __restrict until) {
  const auto kernel = ForKernel::moment(until, CLOCK_REALTIME);
  return BARAKA_NEXT(mq_timedreceive)(queue, message, length, priority, kernel.get());
}

BARAKA_EXPORTED int aio_suspend(const aiocb* const requests[], int count, const timespec* timeout) {
  const auto kernel = ForKernel::duration(timeout);
  return BARAKA_NEXT(aio_suspend)(requests, count, kernel.get());
}
