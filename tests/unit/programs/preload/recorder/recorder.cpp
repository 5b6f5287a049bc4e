#include "tests/unit/programs/preload/recorder/recorder.h"

#include <aio.h>
#include <linux/futex.h>
#include <mqueue.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/times.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstring>
#include <optional>

#include "programs/preload/intercepted.h"

namespace tests::recorder {
namespace {

std::optional<Reaction> reaction;
std::vector<Call> calls;
std::optional<std::int64_t> clock_now;
bool is_sending = false;

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t ns(const timespec* t) {
  return t == nullptr ? kNone : t->tv_sec * kSecond + t->tv_nsec;
}
std::int64_t ns(const timeval* t) {
  return t == nullptr ? kNone : t->tv_sec * kSecond + t->tv_usec * 1000;
}
std::vector<std::int64_t> ns(const itimerspec* t) {
  return {ns(&t->it_interval), ns(&t->it_value)};
}

timespec to_timespec(std::int64_t time) { return {time / kSecond, time % kSecond}; }
timeval to_timeval(std::int64_t time) { return {time / kSecond, time % kSecond / 1000}; }

int react(const char* name, std::vector<std::int64_t> times) {
  calls.push_back({name, std::move(times)});
  if (reaction->result < 0) errno = reaction->error;
  return reaction->result;
}

void write_back(timespec* left) {
  if (left != nullptr) *left = to_timespec(reaction->left);
}
void write_back(timeval* left) {
  if (left != nullptr) *left = to_timeval(reaction->left);
}
void write_back(itimerspec* left) {
  if (left != nullptr) *left = {to_timespec(reaction->interval), to_timespec(reaction->left)};
}
void write_back(itimerval* left) {
  if (left != nullptr) *left = {to_timeval(reaction->interval), to_timeval(reaction->left)};
}

}  // namespace

void arm(const Reaction& wanted) {
  reaction = wanted;
  calls.clear();
}
std::vector<Call> disarm() {
  reaction.reset();
  clock_now.reset();
  return std::move(calls);
}
void set_sending(bool sending) { is_sending = sending; }
void set_clock(std::int64_t now) { clock_now = now; }

}  // namespace tests::recorder

using namespace tests::recorder;

extern "C" {

#define PASS_ON_UNLESS_ARMED(name, ...) \
  if (!reaction) return BARAKA_NEXT(name)(__VA_ARGS__)

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  if (!tests::recorder::clock_now) return BARAKA_NEXT(clock_gettime)(clock, now);
  *now = tests::recorder::to_timespec(*tests::recorder::clock_now);
  return 0;
}
int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  PASS_ON_UNLESS_ARMED(clock_nanosleep, clock, flags, time, left);
  tests::recorder::write_back(left);
  return tests::recorder::react("clock_nanosleep", {tests::recorder::ns(time)});
}
int nanosleep(const timespec* time, timespec* left) {
  PASS_ON_UNLESS_ARMED(nanosleep, time, left);
  const int result = tests::recorder::react("nanosleep", {tests::recorder::ns(time)});
  tests::recorder::write_back(left);
  return result;
}
int pthread_cond_timedwait(pthread_cond_t* c, pthread_mutex_t* m, const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_cond_timedwait, c, m, t);
  return tests::recorder::react("pthread_cond_timedwait", {tests::recorder::ns(t)});
}
int pthread_cond_clockwait(pthread_cond_t* c, pthread_mutex_t* m, clockid_t clock,
                           const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_cond_clockwait, c, m, clock, t);
  return tests::recorder::react("pthread_cond_clockwait", {tests::recorder::ns(t)});
}
int pthread_mutex_timedlock(pthread_mutex_t* m, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_mutex_timedlock, m, t);
  return tests::recorder::react("pthread_mutex_timedlock", {tests::recorder::ns(t)});
}
int pthread_mutex_clocklock(pthread_mutex_t* m, clockid_t clock, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_mutex_clocklock, m, clock, t);
  return tests::recorder::react("pthread_mutex_clocklock", {tests::recorder::ns(t)});
}
int pthread_rwlock_timedrdlock(pthread_rwlock_t* l, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_timedrdlock, l, t);
  return tests::recorder::react("pthread_rwlock_timedrdlock", {tests::recorder::ns(t)});
}
int pthread_rwlock_timedwrlock(pthread_rwlock_t* l, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_timedwrlock, l, t);
  return tests::recorder::react("pthread_rwlock_timedwrlock", {tests::recorder::ns(t)});
}
int pthread_rwlock_clockrdlock(pthread_rwlock_t* l, clockid_t clock, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_clockrdlock, l, clock, t);
  return tests::recorder::react("pthread_rwlock_clockrdlock", {tests::recorder::ns(t)});
}
int pthread_rwlock_clockwrlock(pthread_rwlock_t* l, clockid_t clock, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_clockwrlock, l, clock, t);
  return tests::recorder::react("pthread_rwlock_clockwrlock", {tests::recorder::ns(t)});
}
int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_timedjoin_np, thread, result, t);
  return tests::recorder::react("pthread_timedjoin_np", {tests::recorder::ns(t)});
}
int pthread_clockjoin_np(pthread_t thread, void** result, clockid_t clock, const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_clockjoin_np, thread, result, clock, t);
  return tests::recorder::react("pthread_clockjoin_np", {tests::recorder::ns(t)});
}
int sem_timedwait(sem_t* s, const timespec* t) {
  PASS_ON_UNLESS_ARMED(sem_timedwait, s, t);
  return tests::recorder::react("sem_timedwait", {tests::recorder::ns(t)});
}
int sem_clockwait(sem_t* s, clockid_t clock, const timespec* t) {
  PASS_ON_UNLESS_ARMED(sem_clockwait, s, clock, t);
  return tests::recorder::react("sem_clockwait", {tests::recorder::ns(t)});
}
int semtimedop(int s, sembuf* o, std::size_t n, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(semtimedop, s, o, n, t);
  return tests::recorder::react("semtimedop", {tests::recorder::ns(t)});
}
int mtx_timedlock(mtx_t* m, const timespec* t) {
  PASS_ON_UNLESS_ARMED(mtx_timedlock, m, t);
  return tests::recorder::react("mtx_timedlock", {tests::recorder::ns(t)});
}
int cnd_timedwait(cnd_t* c, mtx_t* m, const timespec* t) {
  PASS_ON_UNLESS_ARMED(cnd_timedwait, c, m, t);
  return tests::recorder::react("cnd_timedwait", {tests::recorder::ns(t)});
}
int mq_timedsend(mqd_t q, const char* m, std::size_t n, unsigned p, const timespec* t) {
  PASS_ON_UNLESS_ARMED(mq_timedsend, q, m, n, p, t);
  return tests::recorder::react("mq_timedsend", {tests::recorder::ns(t)});
}
ssize_t mq_timedreceive(mqd_t q, char* m, std::size_t n, unsigned* p, const timespec* t) {
  PASS_ON_UNLESS_ARMED(mq_timedreceive, q, m, n, p, t);
  return tests::recorder::react("mq_timedreceive", {tests::recorder::ns(t)});
}
int aio_suspend(const aiocb* const r[], int n, const timespec* t) {
  PASS_ON_UNLESS_ARMED(aio_suspend, r, n, t);
  return tests::recorder::react("aio_suspend", {tests::recorder::ns(t)});
}
int poll(pollfd* d, nfds_t n, int timeout) {
  PASS_ON_UNLESS_ARMED(poll, d, n, timeout);
  return tests::recorder::react("poll", {timeout});
}
int ppoll(pollfd* d, nfds_t n, const timespec* t, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(ppoll, d, n, t, s);
  return tests::recorder::react("ppoll", {tests::recorder::ns(t)});
}
int select(int n, fd_set* r, fd_set* w, fd_set* e, timeval* t) {
  PASS_ON_UNLESS_ARMED(select, n, r, w, e, t);
  const int result = tests::recorder::react("select", {tests::recorder::ns(t)});
  tests::recorder::write_back(t);
  return result;
}
int pselect(int n, fd_set* r, fd_set* w, fd_set* e, const timespec* t, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(pselect, n, r, w, e, t, s);
  return tests::recorder::react("pselect", {tests::recorder::ns(t)});
}
int epoll_wait(int p, epoll_event* e, int n, int timeout) {
  PASS_ON_UNLESS_ARMED(epoll_wait, p, e, n, timeout);
  return tests::recorder::react("epoll_wait", {timeout});
}
int epoll_pwait(int p, epoll_event* e, int n, int timeout, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(epoll_pwait, p, e, n, timeout, s);
  return tests::recorder::react("epoll_pwait", {timeout});
}
int epoll_pwait2(int p, epoll_event* e, int n, const timespec* t, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(epoll_pwait2, p, e, n, t, s);
  return tests::recorder::react("epoll_pwait2", {tests::recorder::ns(t)});
}
int sigtimedwait(const sigset_t* s, siginfo_t* i, const timespec* t) {
  PASS_ON_UNLESS_ARMED(sigtimedwait, s, i, t);
  return tests::recorder::react("sigtimedwait", {tests::recorder::ns(t)});
}
int timerfd_settime(int d, int flags, const itimerspec* now, itimerspec* before) noexcept {
  PASS_ON_UNLESS_ARMED(timerfd_settime, d, flags, now, before);
  tests::recorder::write_back(before);
  return tests::recorder::react("timerfd_settime", tests::recorder::ns(now));
}
int timerfd_gettime(int d, itimerspec* now) noexcept {
  PASS_ON_UNLESS_ARMED(timerfd_gettime, d, now);
  tests::recorder::write_back(now);
  return tests::recorder::react("timerfd_gettime", {});
}
int timer_settime(timer_t timer, int flags, const itimerspec* now, itimerspec* before) noexcept {
  PASS_ON_UNLESS_ARMED(timer_settime, timer, flags, now, before);
  tests::recorder::write_back(before);
  return tests::recorder::react("timer_settime", tests::recorder::ns(now));
}
int timer_gettime(timer_t timer, itimerspec* now) noexcept {
  PASS_ON_UNLESS_ARMED(timer_gettime, timer, now);
  tests::recorder::write_back(now);
  return tests::recorder::react("timer_gettime", {});
}
int setitimer(__itimer_which_t which, const itimerval* now, itimerval* before) noexcept {
  PASS_ON_UNLESS_ARMED(setitimer, which, now, before);
  tests::recorder::write_back(before);
  return tests::recorder::react(
      "setitimer", {tests::recorder::ns(&now->it_interval), tests::recorder::ns(&now->it_value)});
}
int getitimer(__itimer_which_t which, itimerval* now) noexcept {
  PASS_ON_UNLESS_ARMED(getitimer, which, now);
  tests::recorder::write_back(now);
  return tests::recorder::react("getitimer", {});
}
int setsockopt(int s, int level, int option, const void* value, socklen_t length) noexcept {
  PASS_ON_UNLESS_ARMED(setsockopt, s, level, option, value, length);
  return tests::recorder::react("setsockopt",
                                {tests::recorder::ns(static_cast<const timeval*>(value))});
}
int getsockopt(int s, int level, int option, void* value, socklen_t* length) noexcept {
  // What a socket is, and what it may wait, the calls that send ask by the way.
  if (level != SOL_SOCKET || (option != SO_RCVTIMEO && option != SO_SNDTIMEO) ||
      tests::recorder::is_sending) {
    return BARAKA_NEXT(getsockopt)(s, level, option, value, length);
  }
  PASS_ON_UNLESS_ARMED(getsockopt, s, level, option, value, length);
  tests::recorder::write_back(static_cast<timeval*>(value));
  return tests::recorder::react("getsockopt", {});
}
int recvmmsg(int s, mmsghdr* m, unsigned n, int flags, timespec* t) {
  PASS_ON_UNLESS_ARMED(recvmmsg, s, m, n, flags, t);
  const int result = tests::recorder::react("recvmmsg", {tests::recorder::ns(t)});
  tests::recorder::write_back(t);
  return result;
}
ssize_t send(int s, const void* bytes, size_t length, int flags) {
  PASS_ON_UNLESS_ARMED(send, s, bytes, length, flags);
  return tests::recorder::react("send", {});
}
ssize_t sendto(int s, const void* bytes, size_t length, int flags, const sockaddr* to,
               socklen_t to_length) {
  PASS_ON_UNLESS_ARMED(sendto, s, bytes, length, flags, to, to_length);
  return tests::recorder::react("sendto", {});
}
ssize_t sendmsg(int s, const msghdr* message, int flags) {
  PASS_ON_UNLESS_ARMED(sendmsg, s, message, flags);
  return tests::recorder::react("sendmsg", {});
}
int sendmmsg(int s, mmsghdr* messages, unsigned count, int flags) {
  PASS_ON_UNLESS_ARMED(sendmmsg, s, messages, count, flags);
  tests::recorder::react("sendmmsg", {count});
  return static_cast<int>(count);
}
ssize_t write(int d, const void* bytes, size_t length) {
  PASS_ON_UNLESS_ARMED(write, d, bytes, length);
  return tests::recorder::react("write", {});
}
ssize_t writev(int d, const iovec* parts, int count) {
  PASS_ON_UNLESS_ARMED(writev, d, parts, count);
  return tests::recorder::react("writev", {});
}
ssize_t recvmsg(int s, msghdr* m, int flags) {
  PASS_ON_UNLESS_ARMED(recvmsg, s, m, flags);
  return tests::recorder::react("recvmsg", {});
}
int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list list;
  va_start(list, request);
  void* const argument = va_arg(list, void*);
  va_end(list);
  PASS_ON_UNLESS_ARMED(ioctl, descriptor, request, argument);
  const timespec t = tests::recorder::to_timespec(tests::recorder::reaction->left);
  std::memcpy(argument, &t, sizeof t);  // as seconds and what is behind them
  return tests::recorder::react("ioctl", {});
}
int getrusage(__rusage_who_t who, rusage* usage) noexcept {
  PASS_ON_UNLESS_ARMED(getrusage, who, usage);
  tests::recorder::write_back(&usage->ru_utime);
  tests::recorder::write_back(&usage->ru_stime);
  return tests::recorder::react("getrusage", {});
}
pid_t wait4(pid_t process, int* status, int options, rusage* usage) noexcept {
  PASS_ON_UNLESS_ARMED(wait4, process, status, options, usage);
  if (usage != nullptr) tests::recorder::write_back(&usage->ru_utime);
  return tests::recorder::react("wait4", {});
}
clock_t times(tms* usage) noexcept {
  PASS_ON_UNLESS_ARMED(times, usage);
  constexpr std::int64_t kTick = tests::recorder::kSecond / 100;
  const clock_t ticks = tests::recorder::reaction->left / kTick;
  if (usage != nullptr) *usage = {ticks, ticks, ticks, ticks};
  return tests::recorder::react("times", {});
}
#ifndef __SANITIZE_ADDRESS__  // see programs/preload/processor_time.cpp
int setrlimit(__rlimit_resource_t resource, const rlimit* limit) noexcept {
  PASS_ON_UNLESS_ARMED(setrlimit, resource, limit);
  return tests::recorder::react("setrlimit", {static_cast<std::int64_t>(limit->rlim_cur),
                                              static_cast<std::int64_t>(limit->rlim_max)});
}
int getrlimit(__rlimit_resource_t resource, rlimit* limit) noexcept {
  PASS_ON_UNLESS_ARMED(getrlimit, resource, limit);
  *limit = {static_cast<rlim_t>(tests::recorder::reaction->left), RLIM_INFINITY};
  return tests::recorder::react("getrlimit", {});
}
#endif
long syscall(long number, ...) noexcept {
  long a[6];
  va_list list;
  va_start(list, number);
  for (long& one : a) one = va_arg(list, long);
  va_end(list);
  PASS_ON_UNLESS_ARMED(syscall, number, a[0], a[1], a[2], a[3], a[4], a[5]);
  const auto time = [&a](int i) {
    return tests::recorder::ns(reinterpret_cast<const timespec*>(a[i]));
  };
  switch (number) {
    case SYS_futex:
      return tests::recorder::react("futex",
                                    {(a[1] & FUTEX_CMD_MASK) == FUTEX_WAKE ? a[3] : time(3)});
    case SYS_ppoll:
    case SYS_rt_sigtimedwait:
      return tests::recorder::react("syscall", {time(2)});
    case SYS_epoll_pwait2:
    case SYS_semtimedop:
      return tests::recorder::react("syscall", {time(3)});
    case SYS_pselect6:
      return tests::recorder::react("syscall", {time(4)});
    case SYS_epoll_pwait:
      return tests::recorder::react("syscall", {a[3]});
    default:
      return tests::recorder::react("syscall", {});
  }
}
}
