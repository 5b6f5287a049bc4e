// Waits for timers of timer_create(), and for signals by descriptors.
#include "kinds.h"

#include <dlfcn.h>
#include <errno.h>
#include <poll.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <unistd.h>

static const struct itimerspec kOnce = {{0, 0}, {0, 1234567}};
static const struct itimerspec kEvery = {{0, 1234567}, {0, 1234567}};

static sigset_t only(int signal) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  return set;
}

static sigset_t blocked(int signal) {
  const sigset_t set = only(signal);
  pthread_sigmask(SIG_BLOCK, &set, NULL);
  return set;
}

static timer_t made(clockid_t clock, int how, int signal, int value) {
  struct sigevent event = {.sigev_notify = how, .sigev_signo = signal, .sigev_value = {.sival_int = value}};
  timer_t timer = 0;
  check(timer_create(clock, &event, &timer) == 0, "timer_create");
  return timer;
}

static void wait_for_signal(const sigset_t* set, int value) {
  siginfo_t info;
  check(sigwaitinfo(set, &info) > 0, "sigwaitinfo");
  check(info.si_code == SI_TIMER && info.si_value.sival_int == value, "what the signal says");
}

static void by_timer(void) {
  const sigset_t set = blocked(SIGRTMIN + 1);
  const timer_t timer = made(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN + 1, 7);
  timer_settime(timer, 0, &kOnce, NULL);
  wait_for_signal(&set, 7);
  timer_delete(timer);
}
static void by_periodic_timer(void) {
  const sigset_t set = blocked(SIGRTMIN + 1);
  const timer_t timer = made(CLOCK_BOOTTIME, SIGEV_SIGNAL, SIGRTMIN + 1, 8);
  timer_settime(timer, 0, &kEvery, NULL);
  for (int i = 0; i < 3; ++i) wait_for_signal(&set, 8);
  check(timer_getoverrun(timer) == 0, "no overrun");
  struct itimerspec left;
  timer_gettime(timer, &left);
  check(left.it_value.tv_nsec == 1234567 && left.it_interval.tv_nsec == 1234567, "timer_gettime");
  timer_delete(timer);
}
static void by_timer_until(void) {
  const sigset_t set = blocked(SIGRTMIN + 1);
  const timer_t timer = made(CLOCK_REALTIME, SIGEV_SIGNAL, SIGRTMIN + 1, 9);
  const struct itimerspec until = {{0, 0}, after(CLOCK_REALTIME, kShort)};
  timer_settime(timer, TIMER_ABSTIME, &until, NULL);
  wait_for_signal(&set, 9);
  timer_delete(timer);
}
static atomic_int handled, order;
static void handle(int signal) {
  ++handled;
  order = order * 10 + (signal - SIGRTMIN);
}
static void by_handler_of_timer(void) {
  signal(SIGALRM, handle);
  timer_t timer;
  check(timer_create(CLOCK_MONOTONIC, NULL, &timer) == 0, "timer_create without an event");
  timer_settime(timer, 0, &kOnce, NULL);
  pause();
  timer_delete(timer);
}
/// The signal is pending while the timer expires nine times more.
static void by_overruns(void) {
  const sigset_t set = blocked(SIGRTMIN + 1);
  const timer_t timer = made(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN + 1, 1);
  timer_settime(timer, 0, &(struct itimerspec){{0, 100000}, {0, 100000}}, NULL);
  nanosleep(&(struct timespec){0, 1050000}, NULL);
  wait_for_signal(&set, 1);
  check(timer_getoverrun(timer) == 9, "nine overruns");
  wait_for_signal(&set, 1);
  check(timer_getoverrun(timer) == 0, "none since");
  timer_delete(timer);
}
/// Both expire at one instant; each handler runs alone.
static void by_two_timers(void) {
  signal(SIGRTMIN + 2, handle);
  signal(SIGRTMIN + 3, handle);
  handled = order = 0;
  const timer_t first = made(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN + 3, 0);
  const timer_t second = made(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN + 2, 0);
  timer_settime(first, 0, &kOnce, NULL);
  timer_settime(second, 0, &kOnce, NULL);
  while (handled < 2) nanosleep(&(struct timespec){0, 1234567}, NULL);
  check(order == 32, "first made, first served");
  timer_delete(first);
  timer_delete(second);
}
static void by_deleted_timer(void) {
  blocked(SIGRTMIN + 1);
  const timer_t timer = made(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN + 1, 1);
  timer_settime(timer, 0, &kOnce, NULL);
  timer_delete(timer);
  nanosleep(&(struct timespec){0, 2000000}, NULL);
  sigset_t pending;
  sigpending(&pending);
  check(!sigismember(&pending, SIGRTMIN + 1), "a timer that was deleted sends nothing");
  check(timer_settime(timer, 0, &kOnce, NULL) != 0, "and cannot be set");
}
static void by_silent_timer(void) {
  const timer_t timer = made(CLOCK_MONOTONIC, SIGEV_NONE, 0, 0);
  timer_settime(timer, 0, &kEvery, NULL);
  nanosleep(&(struct timespec){0, 2000000}, NULL);
  struct itimerspec left;
  timer_gettime(timer, &left);
  check(left.it_value.tv_nsec == 2 * 1234567 - 2000000, "what is left of SIGEV_NONE");
  timer_delete(timer);
}
static sem_t expirations;
static void post(union sigval value) {
  check(value.sival_int == 5, "what the function gets");
  sem_post(&expirations);
}
static void wait_for_threads(const struct itimerspec* setting, int count) {
  struct sigevent event = {.sigev_notify = SIGEV_THREAD, .sigev_value = {.sival_int = 5}};
  event.sigev_notify_function = post;
  timer_t timer;
  sem_init(&expirations, 0, 0);
  check(timer_create(CLOCK_MONOTONIC, &event, &timer) == 0, "timer_create with a function");
  timer_settime(timer, 0, setting, NULL);
  for (int i = 0; i < count; ++i) sem_wait(&expirations);
  timer_delete(timer);
  check(sem_trywait(&expirations) != 0, "no thread more");
}
static void by_thread_of_timer(void) { wait_for_threads(&kOnce, 1); }
static void by_threads_of_timer(void) { wait_for_threads(&kEvery, 3); }

static atomic_int target;
static void* wait_in_thread(void* unused) {
  (void)unused;
  const sigset_t set = blocked(SIGRTMIN + 1);
  target = (int)syscall(SYS_gettid);
  wait_for_signal(&set, 3);
  return NULL;
}
static void set_timer_of_thread(void) {
  while (target == 0) sched_yield();
  struct sigevent event = {.sigev_notify = SIGEV_THREAD_ID, .sigev_signo = SIGRTMIN + 1, .sigev_value = {.sival_int = 3}};
  event._sigev_un._tid = target;
  timer_t timer;
  check(timer_create(CLOCK_MONOTONIC, &event, &timer) == 0, "timer_create for a thread");
  timer_settime(timer, 0, &kOnce, NULL);
}
/// Before it is set, this thread only looks, and may be put to sleep: the time is not known.
static void by_timer_of_thread(void) {
  target = 0;
  with(wait_in_thread, NULL, set_timer_of_thread);
}
static void by_timer_by_syscall(void) {
  const sigset_t set = blocked(SIGRTMIN + 1);
  struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGRTMIN + 1, .sigev_value = {.sival_int = 4}};
  int timer;
  check(syscall(SYS_timer_create, CLOCK_MONOTONIC, &event, &timer) == 0, "timer_create by syscall()");
  syscall(SYS_timer_settime, timer, 0, &kOnce, NULL);
  wait_for_signal(&set, 4);
  syscall(SYS_timer_delete, timer);
}
/// Its number is another file's by the time at which it would have expired.
static void by_closed_timerfd(void) {
  int ends[2];
  (void)!pipe(ends);
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  timerfd_settime(timer, 0, &kEvery, NULL);
  close(timer);
  const int other = dup(ends[1]);
  check(other == timer, "the number is given out again");
  check(poll(&(struct pollfd){ends[0], POLLIN, 0}, 1, 5) == 0, "nobody writes to it");
  close(ends[0]);
  close(ends[1]);
  close(other);
}
/// Of periods that have passed, all are counted, and the next one is in phase.
/// A child sets the timer of its parent, also if it ends before; both see what is left.
static void by_inherited_timerfd(void) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const struct timespec half = {0, 617283};
  const pid_t child = fork();
  if (child == 0) {
    const struct itimerspec twice = {{0, 0}, {0, 2 * 1234567}};
    check(timerfd_settime(timer, 0, &twice, NULL) == 0, "timerfd_settime in a child");
    nanosleep(&half, NULL);
    _exit(0);
  }
  waitpid(child, NULL, 0);
  struct itimerspec left;
  timerfd_gettime(timer, &left);
  check(left.it_value.tv_nsec == 2 * 1234567 - 617283, "what is left of a child's timer");
  uint64_t times = 0;
  check(read(timer, &times, sizeof times) == sizeof times && times == 1, "expirations");
  close(timer);
}
static void by_timerfd_of_a_parent(void) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  timerfd_settime(timer, 0, &kOnce, NULL);
  const pid_t child = fork();
  if (child == 0) {
    uint64_t times = 0;
    struct itimerspec left;
    timerfd_gettime(timer, &left);
    check(left.it_value.tv_nsec == 1234567, "what is left of a parent's timer");
    check(read(timer, &times, sizeof times) == sizeof times && times == 1, "expirations");
    _exit(0);
  }
  nanosleep(&(struct timespec){0, 1000}, NULL);
  close(timer);
  waitpid(child, NULL, 0);
}
static void by_timerfd_of_the_past(void) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const struct itimerspec past = {{0, 1000000}, after(CLOCK_MONOTONIC, -2300000)};
  timerfd_settime(timer, TFD_TIMER_ABSTIME, &past, NULL);
  uint64_t count = 0, more = 0;
  (void)!read(timer, &count, sizeof count);
  (void)!read(timer, &more, sizeof more);
  check(count == 3 && more == 1, "expirations of the past");
  close(timer);
}

/// What the C library itself, and programs that know the vDSO, read of the time.
static void by_vdso(void) {
  void* const library = dlopen("linux-vdso.so.1", RTLD_NOW | RTLD_NOLOAD);
  int (*read_it)(clockid_t, struct timespec*) = NULL;
  *(void**)&read_it = dlvsym(library, "__vdso_clock_gettime", "LINUX_2.6");
  struct timespec before, later;
  read_it(CLOCK_MONOTONIC, &before);
  nanosleep(&kLength, NULL);
  read_it(CLOCK_MONOTONIC, &later);
  const Nanoseconds length = (later.tv_sec - before.tv_sec) * 1000000000LL + later.tv_nsec - before.tv_nsec;
  check(length == kShort, "the time of the vDSO");
}

// ---- signals
static int signals_of(int signal) {
  const sigset_t set = blocked(signal);
  return signalfd(-1, &set, 0);
}
static void start_timer(int signal) {
  timer_settime(made(CLOCK_MONOTONIC, SIGEV_SIGNAL, signal, 6), 0, &kOnce, NULL);
}
static void take_signal(int descriptor, int signal) {
  struct signalfd_siginfo info;
  check(read(descriptor, &info, sizeof info) == sizeof info && (int)info.ssi_signo == signal, "signalfd");
  close(descriptor);
}
static void by_signalfd(void) {
  const int descriptor = signals_of(SIGRTMIN + 4);
  start_timer(SIGRTMIN + 4);
  take_signal(descriptor, SIGRTMIN + 4);
}
static void by_epoll_of_signalfd(void) {
  const int descriptor = signals_of(SIGRTMIN + 5), epoll = epoll_create1(0);
  epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &(struct epoll_event){.events = EPOLLIN});
  start_timer(SIGRTMIN + 5);
  struct epoll_event event;
  check(epoll_wait(epoll, &event, 1, -1) == 1, "epoll of a signalfd");
  take_signal(descriptor, SIGRTMIN + 5);
  close(epoll);
}
static void by_poll_of_signalfd(void) {
  const int descriptor = signals_of(SIGUSR1);
  const pid_t child = fork();
  if (child == 0) {
    nanosleep(&kLength, NULL);
    kill(getppid(), SIGUSR1);
    _exit(0);
  }
  check(poll(&(struct pollfd){descriptor, POLLIN, 0}, 1, -1) == 1, "poll of a signalfd");
  take_signal(descriptor, SIGUSR1);
  waitpid(child, NULL, 0);
}
static void* send_value(void* unused) {
  (void)unused;
  nanosleep(&kLength, NULL);
  sigqueue(getpid(), SIGRTMIN + 6, (union sigval){.sival_int = 11});
  return NULL;
}
static void take_value(void) {
  const sigset_t set = only(SIGRTMIN + 6);
  siginfo_t info;
  check(sigtimedwait(&set, &info, &(struct timespec){5, 0}) > 0 && info.si_value.sival_int == 11, "sigqueue");
}
static void by_sigqueue(void) {
  blocked(SIGRTMIN + 6);
  with(send_value, NULL, take_value);
}
static void by_sigsuspend(void) {
  signal(SIGRTMIN + 7, handle);
  blocked(SIGRTMIN + 7);
  start_timer(SIGRTMIN + 7);
  sigset_t none;
  sigemptyset(&none);
  sigsuspend(&none);
}
static void by_sigwaitinfo_by_syscall(void) {
  const sigset_t set = blocked(SIGRTMIN + 8);
  start_timer(SIGRTMIN + 8);
  check(syscall(SYS_rt_sigtimedwait, &set, NULL, NULL, 8) == SIGRTMIN + 8, "rt_sigtimedwait");
}

/// A handler that runs in a process that waits for its child, and goes on waiting, wakes this one.
static int told[2];
static void tell_by_pipe(int signal) {
  (void)signal;
  for (volatile int i = 0; i < 1000000; ++i) continue;
  (void)!write(told[1], "x", 1);
}
static void wait_for_child_with_handler(void) {
  sigaction(SIGUSR1, &(struct sigaction){.sa_handler = tell_by_pipe, .sa_flags = SA_RESTART}, NULL);
  const sigset_t set = only(SIGUSR1);
  sigprocmask(SIG_UNBLOCK, &set, NULL);
  const pid_t child = fork();
  if (child == 0) {
    nanosleep(&(struct timespec){0, 9000000}, NULL);
    _exit(0);
  }
  check(waitpid(child, NULL, 0) == child, "a wait for a child goes on after a handler");
  _exit(0);
}
static void by_handler_of_another(void) {
  (void)!pipe(told);
  const pid_t other = fork();
  if (other == 0) wait_for_child_with_handler();
  const pid_t sender = fork();
  if (sender == 0) {
    nanosleep(&kLength, NULL);
    kill(other, SIGUSR1);
    _exit(0);
  }
  char byte;
  (void)!read(told[0], &byte, 1);
  kill(other, SIGKILL);
  waitpid(other, NULL, 0);
  waitpid(sender, NULL, 0);
}

const struct Kind timer_kinds[] = {
    {"timer_create", by_timer, 1234567},
    {"timer_create, periodic", by_periodic_timer, 3 * 1234567},
    {"timer_create, until", by_timer_until, 1234567},
    {"timer_create, handler", by_handler_of_timer, 1234567},
    {"timer_create, overruns", by_overruns, 1100000},
    {"timer_create, two at once", by_two_timers, 1234567},
    {"timer_create, deleted", by_deleted_timer, 2000000},
    {"timer_create, SIGEV_NONE", by_silent_timer, 2000000},
    {"timer_create, SIGEV_THREAD", by_thread_of_timer, 1234567},
    {"timer_create, SIGEV_THREAD, periodic", by_threads_of_timer, 3 * 1234567},
    {"timer_create, SIGEV_THREAD_ID", by_timer_of_thread, 0},
    {"timer_create by syscall()", by_timer_by_syscall, 1234567},
    {"timerfd, closed", by_closed_timerfd, 5000000},
    {"timerfd, set by a child", by_inherited_timerfd, 2 * 1234567},
    {"timerfd, closed by the parent", by_timerfd_of_a_parent, 1234567},
    {"timerfd, of the past", by_timerfd_of_the_past, 700000},
    {"vdso", by_vdso, 1234567},
    {"signalfd", by_signalfd, 1234567},
    {"signalfd, epoll", by_epoll_of_signalfd, 1234567},
    {"signalfd, poll", by_poll_of_signalfd, 1234567},
    {"sigqueue", by_sigqueue, 1234567},
    {"handler during a waitpid", by_handler_of_another, 1234567},
    {"sigsuspend", by_sigsuspend, 1234567},
    {"rt_sigtimedwait by syscall()", by_sigwaitinfo_by_syscall, 1234567},
};
const size_t timer_kinds_count = sizeof timer_kinds / sizeof *timer_kinds;
