#include "tests/unit/gateway/dilate/recorder/recorder.h"

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

#include "gateway/dilate/intercepted.h"

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
  if (!clock_now) return BARAKA_NEXT(clock_gettime)(clock, now);
  *now = to_timespec(*clock_now);
  return 0;
}
int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  PASS_ON_UNLESS_ARMED(clock_nanosleep, clock, flags, time, left);
  write_back(left);
  return react("clock_nanosleep", {ns(time)});
}
int nanosleep(const timespec* time, timespec* left) {
  PASS_ON_UNLESS_ARMED(nanosleep, time, left);
  const int result = react("nanosleep", {ns(time)});
  write_back(left);
  return result;
}
int pthread_cond_timedwait(pthread_cond_t* c, pthread_mutex_t* m, const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_cond_timedwait, c, m, t);
  return react("pthread_cond_timedwait", {ns(t)});
}
int pthread_cond_clockwait(pthread_cond_t* c, pthread_mutex_t* m, clockid_t clock,
                           const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_cond_clockwait, c, m, clock, t);
  return react("pthread_cond_clockwait", {ns(t)});
}
int pthread_mutex_timedlock(pthread_mutex_t* m, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_mutex_timedlock, m, t);
  return react("pthread_mutex_timedlock", {ns(t)});
}
int pthread_mutex_clocklock(pthread_mutex_t* m, clockid_t clock, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_mutex_clocklock, m, clock, t);
  return react("pthread_mutex_clocklock", {ns(t)});
}
int pthread_rwlock_timedrdlock(pthread_rwlock_t* l, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_timedrdlock, l, t);
  return react("pthread_rwlock_timedrdlock", {ns(t)});
}
int pthread_rwlock_timedwrlock(pthread_rwlock_t* l, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_timedwrlock, l, t);
  return react("pthread_rwlock_timedwrlock", {ns(t)});
}
int pthread_rwlock_clockrdlock(pthread_rwlock_t* l, clockid_t clock, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_clockrdlock, l, clock, t);
  return react("pthread_rwlock_clockrdlock", {ns(t)});
}
int pthread_rwlock_clockwrlock(pthread_rwlock_t* l, clockid_t clock, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(pthread_rwlock_clockwrlock, l, clock, t);
  return react("pthread_rwlock_clockwrlock", {ns(t)});
}
int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_timedjoin_np, thread, result, t);
  return react("pthread_timedjoin_np", {ns(t)});
}
int pthread_clockjoin_np(pthread_t thread, void** result, clockid_t clock, const timespec* t) {
  PASS_ON_UNLESS_ARMED(pthread_clockjoin_np, thread, result, clock, t);
  return react("pthread_clockjoin_np", {ns(t)});
}
int sem_timedwait(sem_t* s, const timespec* t) {
  PASS_ON_UNLESS_ARMED(sem_timedwait, s, t);
  return react("sem_timedwait", {ns(t)});
}
int sem_clockwait(sem_t* s, clockid_t clock, const timespec* t) {
  PASS_ON_UNLESS_ARMED(sem_clockwait, s, clock, t);
  return react("sem_clockwait", {ns(t)});
}
int semtimedop(int s, sembuf* o, std::size_t n, const timespec* t) noexcept {
  PASS_ON_UNLESS_ARMED(semtimedop, s, o, n, t);
  return react("semtimedop", {ns(t)});
}
int mtx_timedlock(mtx_t* m, const timespec* t) {
  PASS_ON_UNLESS_ARMED(mtx_timedlock, m, t);
  return react("mtx_timedlock", {ns(t)});
}
int cnd_timedwait(cnd_t* c, mtx_t* m, const timespec* t) {
  PASS_ON_UNLESS_ARMED(cnd_timedwait, c, m, t);
  return react("cnd_timedwait", {ns(t)});
}
int mq_timedsend(mqd_t q, const char* m, std::size_t n, unsigned p, const timespec* t) {
  PASS_ON_UNLESS_ARMED(mq_timedsend, q, m, n, p, t);
  return react("mq_timedsend", {ns(t)});
}
ssize_t mq_timedreceive(mqd_t q, char* m, std::size_t n, unsigned* p, const timespec* t) {
  PASS_ON_UNLESS_ARMED(mq_timedreceive, q, m, n, p, t);
  return react("mq_timedreceive", {ns(t)});
}
int aio_suspend(const aiocb* const r[], int n, const timespec* t) {
  PASS_ON_UNLESS_ARMED(aio_suspend, r, n, t);
  return react("aio_suspend", {ns(t)});
}
int poll(pollfd* d, nfds_t n, int timeout) {
  PASS_ON_UNLESS_ARMED(poll, d, n, timeout);
  return react("poll", {timeout});
}
int ppoll(pollfd* d, nfds_t n, const timespec* t, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(ppoll, d, n, t, s);
  return react("ppoll", {ns(t)});
}
int select(int n, fd_set* r, fd_set* w, fd_set* e, timeval* t) {
  PASS_ON_UNLESS_ARMED(select, n, r, w, e, t);
  const int result = react("select", {ns(t)});
  write_back(t);
  return result;
}
int pselect(int n, fd_set* r, fd_set* w, fd_set* e, const timespec* t, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(pselect, n, r, w, e, t, s);
  return react("pselect", {ns(t)});
}
int epoll_wait(int p, epoll_event* e, int n, int timeout) {
  PASS_ON_UNLESS_ARMED(epoll_wait, p, e, n, timeout);
  return react("epoll_wait", {timeout});
}
int epoll_pwait(int p, epoll_event* e, int n, int timeout, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(epoll_pwait, p, e, n, timeout, s);
  return react("epoll_pwait", {timeout});
}
int epoll_pwait2(int p, epoll_event* e, int n, const timespec* t, const sigset_t* s) {
  PASS_ON_UNLESS_ARMED(epoll_pwait2, p, e, n, t, s);
  return react("epoll_pwait2", {ns(t)});
}
int sigtimedwait(const sigset_t* s, siginfo_t* i, const timespec* t) {
  PASS_ON_UNLESS_ARMED(sigtimedwait, s, i, t);
  return react("sigtimedwait", {ns(t)});
}
int timerfd_settime(int d, int flags, const itimerspec* now, itimerspec* before) noexcept {
  PASS_ON_UNLESS_ARMED(timerfd_settime, d, flags, now, before);
  write_back(before);
  return react("timerfd_settime", ns(now));
}
int timerfd_gettime(int d, itimerspec* now) noexcept {
  PASS_ON_UNLESS_ARMED(timerfd_gettime, d, now);
  write_back(now);
  return react("timerfd_gettime", {});
}
int timer_settime(timer_t timer, int flags, const itimerspec* now, itimerspec* before) noexcept {
  PASS_ON_UNLESS_ARMED(timer_settime, timer, flags, now, before);
  write_back(before);
  return react("timer_settime", ns(now));
}
int timer_gettime(timer_t timer, itimerspec* now) noexcept {
  PASS_ON_UNLESS_ARMED(timer_gettime, timer, now);
  write_back(now);
  return react("timer_gettime", {});
}
int setitimer(__itimer_which_t which, const itimerval* now, itimerval* before) noexcept {
  PASS_ON_UNLESS_ARMED(setitimer, which, now, before);
  write_back(before);
  return react("setitimer", {ns(&now->it_interval), ns(&now->it_value)});
}
int getitimer(__itimer_which_t which, itimerval* now) noexcept {
  PASS_ON_UNLESS_ARMED(getitimer, which, now);
  write_back(now);
  return react("getitimer", {});
}
int setsockopt(int s, int level, int option, const void* value, socklen_t length) noexcept {
  PASS_ON_UNLESS_ARMED(setsockopt, s, level, option, value, length);
  return react("setsockopt", {ns(static_cast<const timeval*>(value))});
}
int getsockopt(int s, int level, int option, void* value, socklen_t* length) noexcept {
  // What a socket is, and what it may wait, the calls that send ask by the way.
  if (level != SOL_SOCKET || (option != SO_RCVTIMEO && option != SO_SNDTIMEO) || is_sending) {
    return BARAKA_NEXT(getsockopt)(s, level, option, value, length);
  }
  PASS_ON_UNLESS_ARMED(getsockopt, s, level, option, value, length);
  write_back(static_cast<timeval*>(value));
  return react("getsockopt", {});
}
int recvmmsg(int s, mmsghdr* m, unsigned n, int flags, timespec* t) {
  PASS_ON_UNLESS_ARMED(recvmmsg, s, m, n, flags, t);
  const int result = react("recvmmsg", {ns(t)});
  write_back(t);
  return result;
}
ssize_t send(int s, const void* bytes, size_t length, int flags) {
  PASS_ON_UNLESS_ARMED(send, s, bytes, length, flags);
  return react("send", {});
}
ssize_t sendto(int s, const void* bytes, size_t length, int flags, const sockaddr* to,
               socklen_t to_length) {
  PASS_ON_UNLESS_ARMED(sendto, s, bytes, length, flags, to, to_length);
  return react("sendto", {});
}
ssize_t sendmsg(int s, const msghdr* message, int flags) {
  PASS_ON_UNLESS_ARMED(sendmsg, s, message, flags);
  return react("sendmsg", {});
}
int sendmmsg(int s, mmsghdr* messages, unsigned count, int flags) {
  PASS_ON_UNLESS_ARMED(sendmmsg, s, messages, count, flags);
  react("sendmmsg", {count});
  return static_cast<int>(count);
}
ssize_t write(int d, const void* bytes, size_t length) {
  PASS_ON_UNLESS_ARMED(write, d, bytes, length);
  return react("write", {});
}
ssize_t writev(int d, const iovec* parts, int count) {
  PASS_ON_UNLESS_ARMED(writev, d, parts, count);
  return react("writev", {});
}
ssize_t recvmsg(int s, msghdr* m, int flags) {
  PASS_ON_UNLESS_ARMED(recvmsg, s, m, flags);
  return react("recvmsg", {});
}
int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list list;
  va_start(list, request);
  void* const argument = va_arg(list, void*);
  va_end(list);
  PASS_ON_UNLESS_ARMED(ioctl, descriptor, request, argument);
  const timespec t = to_timespec(reaction->left);
  std::memcpy(argument, &t, sizeof t);  // as seconds and what is behind them
  return react("ioctl", {});
}
int getrusage(__rusage_who_t who, rusage* usage) noexcept {
  PASS_ON_UNLESS_ARMED(getrusage, who, usage);
  write_back(&usage->ru_utime);
  write_back(&usage->ru_stime);
  return react("getrusage", {});
}
pid_t wait4(pid_t process, int* status, int options, rusage* usage) noexcept {
  PASS_ON_UNLESS_ARMED(wait4, process, status, options, usage);
  if (usage != nullptr) write_back(&usage->ru_utime);
  return react("wait4", {});
}
clock_t times(tms* usage) noexcept {
  PASS_ON_UNLESS_ARMED(times, usage);
  constexpr std::int64_t kTick = kSecond / 100;
  const clock_t ticks = reaction->left / kTick;
  if (usage != nullptr) *usage = {ticks, ticks, ticks, ticks};
  return react("times", {});
}
#ifndef __SANITIZE_ADDRESS__  // see gateway/dilate/processor_time.cpp
int setrlimit(__rlimit_resource_t resource, const rlimit* limit) noexcept {
  PASS_ON_UNLESS_ARMED(setrlimit, resource, limit);
  return react("setrlimit", {static_cast<std::int64_t>(limit->rlim_cur),
                             static_cast<std::int64_t>(limit->rlim_max)});
}
int getrlimit(__rlimit_resource_t resource, rlimit* limit) noexcept {
  PASS_ON_UNLESS_ARMED(getrlimit, resource, limit);
  *limit = {static_cast<rlim_t>(reaction->left), RLIM_INFINITY};
  return react("getrlimit", {});
}
#endif
long syscall(long number, ...) noexcept {
  long a[6];
  va_list list;
  va_start(list, number);
  for (long& one : a) one = va_arg(list, long);
  va_end(list);
  PASS_ON_UNLESS_ARMED(syscall, number, a[0], a[1], a[2], a[3], a[4], a[5]);
  const auto time = [&a](int i) { return ns(reinterpret_cast<const timespec*>(a[i])); };
  switch (number) {
    case SYS_futex:
      return react("futex", {(a[1] & FUTEX_CMD_MASK) == FUTEX_WAKE ? a[3] : time(3)});
    case SYS_ppoll:
    case SYS_rt_sigtimedwait:
      return react("syscall", {time(2)});
    case SYS_epoll_pwait2:
    case SYS_semtimedop:
      return react("syscall", {time(3)});
    case SYS_pselect6:
      return react("syscall", {time(4)});
    case SYS_epoll_pwait:
      return react("syscall", {a[3]});
    default:
      return react("syscall", {});
  }
}
}
