// The steps of random plans: see random_program.c. Each is one or two calls that may wait.
#define _GNU_SOURCE
#include <errno.h>
#include <linux/futex.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "random_program.h"

enum { kObjects = 2 };

/// A number that is counted up by some and down by others, who wait for it.
struct Counter {
  pthread_mutex_t mutex;
  pthread_cond_t condition;
  int64_t value;
};

/// Each process has its own.
static struct {
  pthread_mutex_t mutexes[kObjects];
  struct Counter counters[kObjects];
  sem_t semaphores[kObjects];
  pthread_rwlock_t lock;
  pthread_barrier_t barrier;
  atomic_uint word;
  pthread_t threads[kMostThreads];
  volatile char is_live[kMostThreads];
  pid_t children[kMostProcesses];
} own;

static _Thread_local int this_thread;
static _Thread_local int held;  // mutexes, by bits; bit kObjects: the lock

static struct timespec to_timespec(Nanoseconds time) {
  return (struct timespec){time / 1000000000, time % 1000000000};
}

static struct timespec after(clockid_t clock, Nanoseconds length) {
  struct timespec now;
  clock_gettime(clock, &now);
  return to_timespec(now.tv_sec * 1000000000LL + now.tv_nsec + length);
}

static int64_t status_of(int64_t result) { return result < 0 ? -errno : result; }

static void on_signal(int signal) {
  const int kept = errno;
  (void)getppid();  // the C library's own system call, while all signals are blocked
  add_record(this_thread, -1, signal);
  errno = kept;
}

// ---- sleeps
static int64_t do_sleep(const int64_t* a) {
  const struct timespec time = to_timespec(a[0]);
  return status_of(nanosleep(&time, NULL));
}
static int64_t do_sleep_until(const int64_t* a) {
  const struct timespec until = after(CLOCK_REALTIME, a[0]);
  return -clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &until, NULL);
}

// ---- mutexes and locks
static int64_t hold(int bit, int error) {
  if (error == 0) held |= 1 << bit;
  return -error;
}
static int64_t do_lock(const int64_t* a) {
  if (held & 1 << a[0]) return 1;
  if (a[1] == 0) return hold((int)a[0], pthread_mutex_lock(&own.mutexes[a[0]]));
  const struct timespec until = after(CLOCK_REALTIME, a[1]);
  return hold((int)a[0], pthread_mutex_timedlock(&own.mutexes[a[0]], &until));
}
static int64_t do_unlock(const int64_t* a) {
  if (!(held & 1 << a[0])) return 1;
  held &= ~(1 << a[0]);
  return -pthread_mutex_unlock(&own.mutexes[a[0]]);
}
static int64_t do_read_lock(const int64_t* a) {
  if (held & 1 << kObjects) return 1;
  if (a[0] == 0) return hold(kObjects, pthread_rwlock_rdlock(&own.lock));
  const struct timespec until = after(CLOCK_REALTIME, a[0]);
  return hold(kObjects, pthread_rwlock_timedrdlock(&own.lock, &until));
}
static int64_t do_write_lock(const int64_t* a) {
  if (held & 1 << kObjects) return 1;
  if (a[0] == 0) return hold(kObjects, pthread_rwlock_wrlock(&own.lock));
  const struct timespec until = after(CLOCK_MONOTONIC, a[0]);
  return hold(kObjects, pthread_rwlock_clockwrlock(&own.lock, CLOCK_MONOTONIC, &until));
}
static int64_t do_release(const int64_t* a) {
  (void)a;
  if (!(held & 1 << kObjects)) return 1;
  held &= ~(1 << kObjects);
  return -pthread_rwlock_unlock(&own.lock);
}

// ---- condition variables, semaphores, barriers, futexes
static int64_t do_take(const int64_t* a) {
  struct Counter* const counter = &own.counters[a[0]];
  const struct timespec until = after(CLOCK_REALTIME, a[1]);
  int error = 0;
  pthread_mutex_lock(&counter->mutex);
  while (counter->value == 0 && error == 0) {
    error = a[1] == 0 ? pthread_cond_wait(&counter->condition, &counter->mutex)
                      : pthread_cond_timedwait(&counter->condition, &counter->mutex, &until);
  }
  if (error == 0) --counter->value;
  pthread_mutex_unlock(&counter->mutex);
  return -error;
}
static int64_t do_give(const int64_t* a) {
  struct Counter* const counter = &own.counters[a[0]];
  pthread_mutex_lock(&counter->mutex);
  counter->value += a[1];
  if (a[1] == 1) {
    pthread_cond_signal(&counter->condition);
  } else {
    pthread_cond_broadcast(&counter->condition);
  }
  pthread_mutex_unlock(&counter->mutex);
  return a[1];
}
static int64_t do_down(const int64_t* a) {
  if (a[1] == 0) return status_of(sem_wait(&own.semaphores[a[0]]));
  const struct timespec until = after(CLOCK_REALTIME, a[1]);
  return status_of(sem_timedwait(&own.semaphores[a[0]], &until));
}
static int64_t do_up(const int64_t* a) { return status_of(sem_post(&own.semaphores[a[0]])); }
static int64_t do_barrier(const int64_t* a) {
  (void)a;
  return pthread_barrier_wait(&own.barrier) == PTHREAD_BARRIER_SERIAL_THREAD;
}
static int64_t do_futex_wait(const int64_t* a) {
  const struct timespec time = to_timespec(a[0]);
  return status_of(syscall(SYS_futex, &own.word, FUTEX_WAIT_PRIVATE, atomic_load(&own.word),
                           a[0] == 0 ? NULL : &time, NULL, 0));
}
static int64_t do_futex_wake(const int64_t* a) {
  atomic_fetch_add(&own.word, 1);
  return status_of(syscall(SYS_futex, &own.word, FUTEX_WAKE_PRIVATE, a[0], NULL, NULL, 0));
}

// ---- descriptors
static char bytes[1 << 16];

static int64_t do_write(const int64_t* a) {
  const uint64_t one = (uint64_t)a[1];
  const int is_counted = a[0] == kEvent0 || a[0] == kEvent1;
  return status_of(write(writable[a[0]], is_counted ? (const void*)&one : bytes,
                         is_counted ? sizeof one : (size_t)a[1]));
}
/// Of what counts, the count.
static int64_t do_read(const int64_t* a) {
  const int is_counted = a[0] == kEvent0 || a[0] == kEvent1 || a[0] >= kTimer0;
  uint64_t count = 0;
  const ssize_t length = is_counted ? read(readable[a[0]], &count, sizeof count)
                                    : read(readable[a[0]], bytes, (size_t)a[1]);
  return length > 0 && is_counted ? (int64_t)count : status_of(length);
}
static int64_t do_send(const int64_t* a) {
  return status_of(send(writable[a[0]], bytes, (size_t)a[1], 0));
}
/// Of a socket, at most a[1] bytes within a[2]; in microseconds; 0: without end.
static int64_t do_receive(const int64_t* a) {
  const struct timeval time = {0, a[2]};
  setsockopt(readable[a[0]], SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
  const int64_t result = status_of(recv(readable[a[0]], bytes, (size_t)a[1], 0));
  return result;
}

enum { kByPoll, kByPpoll, kBySelect, kByPselect, kByEpoll, kByEpollPwait2 };

static int64_t wait_by_poll(int kind, int64_t mask, Nanoseconds time) {
  struct pollfd all[kDescriptors];
  for (int i = 0; i < kDescriptors; ++i)
    all[i] = (struct pollfd){mask & 1 << i ? readable[i] : -1, POLLIN, 0};
  const struct timespec length = to_timespec(time);
  const int ready = kind == kByPoll ? poll(all, kDescriptors, (int)(time / 1000000))
                                    : ppoll(all, kDescriptors, &length, NULL);
  int64_t found = 0;
  for (int i = 0; i < kDescriptors; ++i) {
    if (ready > 0 && all[i].revents != 0) found |= 1 << i;
  }
  return ready < 0 ? -errno : found;
}
static int64_t wait_by_select(int kind, int64_t mask, Nanoseconds time) {
  fd_set set;
  FD_ZERO(&set);
  for (int i = 0; i < kDescriptors; ++i) {
    if (mask & 1 << i) FD_SET(readable[i], &set);
  }
  const struct timespec length = to_timespec(time);
  struct timeval coarse = {time / 1000000000, time % 1000000000 / 1000};
  const int ready = kind == kBySelect ? select(FD_SETSIZE, &set, NULL, NULL, &coarse)
                                      : pselect(FD_SETSIZE, &set, NULL, NULL, &length, NULL);
  int64_t found = 0;
  for (int i = 0; i < kDescriptors; ++i) {
    if (ready > 0 && mask & 1 << i && FD_ISSET(readable[i], &set)) found |= 1 << i;
  }
  return ready < 0 ? -errno : found;
}
static int64_t wait_by_epoll(int kind, int64_t mask, Nanoseconds time) {
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  for (int i = 0; i < kDescriptors; ++i) {
    struct epoll_event event = {.events = EPOLLIN, .data.u32 = 1U << i};
    if (mask & 1 << i) epoll_ctl(epoll, EPOLL_CTL_ADD, readable[i], &event);
  }
  struct epoll_event found[kDescriptors];
  const struct timespec length = to_timespec(time);
  const int ready = kind == kByEpoll ? epoll_wait(epoll, found, kDescriptors, (int)(time / 1000000))
                                     : epoll_pwait2(epoll, found, kDescriptors, &length, NULL);
  int64_t result = ready < 0 ? -errno : 0;
  for (int i = 0; i < ready; ++i) result |= found[i].data.u32;
  close(epoll);
  return result;
}
/// Which of some descriptors can be read. @return bits; 0: none within the time.
static int64_t do_wait(const int64_t* a) {
  const int kind = (int)a[0];
  if (kind == kByPoll || kind == kByPpoll) return wait_by_poll(kind, a[1], a[2]);
  if (kind == kBySelect || kind == kByPselect) return wait_by_select(kind, a[1], a[2]);
  return wait_by_epoll(kind, a[1], a[2]);
}

// ---- timers and signals
static int64_t do_set_timer(const int64_t* a) {
  const struct itimerspec setting = {to_timespec(a[2]), to_timespec(a[1])};
  return status_of(timerfd_settime(readable[a[0]], 0, &setting, NULL));
}
/// Closed while it goes on; what gets its number is not to hear of it.
static int64_t do_close_timer(const int64_t* a) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
  const struct itimerspec setting = {to_timespec(a[0]), to_timespec(a[0])};
  timerfd_settime(timer, 0, &setting, NULL);
  close(timer);
  const int next = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  const struct timespec until = after(CLOCK_MONOTONIC, 3 * a[0]);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) == EINTR) continue;
  uint64_t count;
  const int64_t result = next == timer ? status_of(read(next, &count, sizeof count)) : next;
  close(next);
  return result;
}
static struct timeval to_timeval(Nanoseconds time) {
  return (struct timeval){time / 1000000000, time % 1000000000 / 1000};
}
static int64_t do_set_alarm(const int64_t* a) {
  const struct itimerval setting = {to_timeval(a[1]), to_timeval(a[0])};
  return status_of(setitimer(ITIMER_REAL, &setting, NULL));
}
/// For SIGALRM. Only the first thread of a process takes it at all.
static int64_t do_wait_for_signal(const int64_t* a) {
  sigset_t alarm, before;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  pthread_sigmask(SIG_BLOCK, &alarm, &before);
  const struct timespec time = to_timespec(a[0]);
  const int64_t result = status_of(sigtimedwait(&alarm, NULL, &time));
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return result;
}
/// To a thread of this process.
static int64_t do_tell_thread(const int64_t* a) {
  return own.is_live[a[0]] ? -pthread_kill(own.threads[a[0]], SIGUSR2) : -ESRCH;
}
/// To a child of this process, or to itself.
static int64_t do_tell_process(const int64_t* a) {
  const pid_t child = a[0] < 0 ? getpid() : own.children[a[0]];
  return child == 0 ? -ESRCH : status_of(kill(child, SIGUSR1));
}
static int64_t do_kill(const int64_t* a) {
  return own.children[a[0]] == 0 ? -ESRCH : status_of(kill(own.children[a[0]], SIGKILL));
}

// ---- threads and processes
static void block_signals_of_process(int how) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGALRM);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(how, &set, NULL);
}
static void* thread_of(void* number) {
  const int thread = (int)(intptr_t)number;
  own.is_live[thread] = 1;
  carry_out(thread);
  own.is_live[thread] = 0;
  return NULL;
}
static int is_first_thread(void) { return getpid() == (pid_t)syscall(SYS_gettid); }
static int64_t do_create(const int64_t* a) {
  const int is_first = is_first_thread();
  if (is_first) block_signals_of_process(SIG_BLOCK);
  const int error = pthread_create(&own.threads[a[0]], NULL, thread_of, (void*)(intptr_t)a[0]);
  if (is_first) block_signals_of_process(SIG_UNBLOCK);
  return -error;
}
static int64_t do_join(const int64_t* a) { return -pthread_join(own.threads[a[0]], NULL); }
/// The child handles signals from its first turn on.
static int64_t do_fork(const int64_t* a) {
  const int is_first = is_first_thread();
  block_signals_of_process(SIG_BLOCK);
  const pid_t child = fork();
  if (child == 0) {
    begin_process((int)a[1]);
    const int status = carry_out((int)a[1]);
    if (a[0] % 2 == 0) _exit(status);
    exit(status);
  }
  if (is_first) block_signals_of_process(SIG_UNBLOCK);
  own.children[a[0]] = child > 0 ? child : 0;
  return child < 0 ? -errno : 0;
}
enum { kUntilItEnds, kLookOnce, kUnlessInterrupted };
static int64_t do_wait_for_child(const int64_t* a) {
  int status = 0;
  const pid_t child = own.children[a[0]];
  if (child == 0) return -ECHILD;
  pid_t found;
  do {
    found = waitpid(child, &status, a[1] == kLookOnce ? WNOHANG : 0);
  } while (found < 0 && errno == EINTR && a[1] == kUntilItEnds);
  if (found < 0) return -errno;
  if (found == 0) return 1000;
  own.children[a[0]] = 0;
  return WIFSIGNALED(status) ? 100 + WTERMSIG(status) : WEXITSTATUS(status);
}
static void* end_at_once(void* nothing) { return nothing; }
/// A process that ends while its threads have hardly begun.
static int64_t do_leave(const int64_t* a) {
  int status;
  const pid_t child = fork();
  if (child == 0) {
    pthread_t thread;
    for (int i = 0; i < a[0]; ++i) pthread_create(&thread, NULL, end_at_once, NULL);
    _exit(1);
  }
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WEXITSTATUS(status);
}
/// Another program, which sleeps for as many microseconds.
static int64_t do_spawn(const int64_t* a) {
  extern char** environ;
  char length[16];
  snprintf(length, sizeof length, "0.%06ld", a[0]);
  char* const words[] = {"sleep", length, NULL};
  pid_t child;
  int status;
  const int error = posix_spawnp(&child, "sleep", NULL, NULL, words, environ);
  if (error != 0) return -error;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WEXITSTATUS(status);
}

static const struct {
  const char* name;
  Action action;
} names[] = {
    {"sleep", do_sleep},
    {"sleep_until", do_sleep_until},
    {"lock", do_lock},
    {"unlock", do_unlock},
    {"read_lock", do_read_lock},
    {"write_lock", do_write_lock},
    {"release", do_release},
    {"take", do_take},
    {"give", do_give},
    {"down", do_down},
    {"up", do_up},
    {"barrier", do_barrier},
    {"futex_wait", do_futex_wait},
    {"futex_wake", do_futex_wake},
    {"write", do_write},
    {"read", do_read},
    {"send", do_send},
    {"receive", do_receive},
    {"wait", do_wait},
    {"set_timer", do_set_timer},
    {"close_timer", do_close_timer},
    {"set_alarm", do_set_alarm},
    {"wait_for_signal", do_wait_for_signal},
    {"tell_thread", do_tell_thread},
    {"tell_process", do_tell_process},
    {"kill", do_kill},
    {"create", do_create},
    {"join", do_join},
    {"fork", do_fork},
    {"wait_for_child", do_wait_for_child},
    {"spawn", do_spawn},
    {"leave", do_leave},
};

Action action_of(const char* name) {
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    if (strcmp(names[i].name, name) == 0) return names[i].action;
  }
  return NULL;
}

int carry_out(int thread) {
  this_thread = thread;
  held = 0;
  const struct ThreadPlan* const steps = &plan.threads[thread];
  for (int i = 0; i < steps->steps; ++i) {
    const int64_t result = steps->all[i].action(steps->all[i].arguments);
    add_record(thread, i, result);
  }
  return plan.threads[thread].process + 10;
}

void begin_process(int first) {
  this_thread = first;
  memset(&own, 0, sizeof own);
  own.threads[first] = pthread_self();
  own.is_live[first] = 1;
  for (int i = 0; i < kObjects; ++i) {
    pthread_mutex_init(&own.mutexes[i], NULL);
    pthread_mutex_init(&own.counters[i].mutex, NULL);
    pthread_cond_init(&own.counters[i].condition, NULL);
    sem_init(&own.semaphores[i], 0, 0);
  }
  pthread_rwlock_init(&own.lock, NULL);
  pthread_barrier_init(&own.barrier, NULL, 2);
  struct sigaction action = {.sa_handler = on_signal};
  sigfillset(&action.sa_mask);
  sigaction(SIGALRM, &action, NULL);
  sigaction(SIGUSR1, &action, NULL);
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR2, &action, NULL);
  for (int i = kTimer0; i <= kTimer1; ++i)
    readable[i] = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
  block_signals_of_process(SIG_UNBLOCK);
}
