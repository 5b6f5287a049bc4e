// Waits in as many ways as there are, and prints how long each took: "name: nanoseconds expected".
// In lock-step both are equal. One line for each kind, so that a missing one is seen. More kinds are
// in the other files of this folder.
#include "kinds.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdint.h>
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
#include <threads.h>
#include <time.h>
#include <unistd.h>

Nanoseconds read_clock(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return now.tv_sec * 1000000000LL + now.tv_nsec;
}

struct timespec to_timespec(Nanoseconds time) {
  return (struct timespec){time / 1000000000, time % 1000000000};
}

struct timespec after(clockid_t clock, Nanoseconds length) {
  return to_timespec(read_clock(clock) + length);
}

void check(int is_right, const char* what) {
  if (!is_right) printf("wrong: %s\n", what);
}

// ---- sleeps
static void by_nanosleep(void) { nanosleep(&kLength, NULL); }
static void by_clock_nanosleep(void) { clock_nanosleep(CLOCK_MONOTONIC, 0, &kLength, NULL); }
static void until_monotonic(void) {
  const struct timespec until = after(CLOCK_MONOTONIC, kShort);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
}
static void until_realtime(void) {
  const struct timespec until = after(CLOCK_REALTIME, kShort);
  clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &until, NULL);
}
static void by_usleep(void) { usleep(1234); }
static void by_sleep(void) { sleep(1); }
static void by_thrd_sleep(void) { thrd_sleep(&kLength, NULL); }
static void by_raw_nanosleep(void) { syscall(SYS_nanosleep, &kLength, NULL); }

// ---- descriptors
static int ends[2], sockets[2];

static void by_poll(void) { poll(&(struct pollfd){ends[0], POLLIN, 0}, 1, 7); }
static void by_ppoll(void) { ppoll(&(struct pollfd){ends[0], POLLIN, 0}, 1, &kLength, NULL); }
static void by_select(void) {
  fd_set set;
  FD_ZERO(&set);
  FD_SET(ends[0], &set);
  select(ends[0] + 1, &set, NULL, NULL, &(struct timeval){0, 1234});
}
static void by_pselect(void) { pselect(0, NULL, NULL, NULL, &kLength, NULL); }

static int epoll_of_pipe(void) {
  const int epoll = epoll_create1(0);
  epoll_ctl(epoll, EPOLL_CTL_ADD, ends[0], &(struct epoll_event){.events = EPOLLIN});
  return epoll;
}
static void by_epoll_wait(void) {
  const int epoll = epoll_of_pipe();
  struct epoll_event event;
  epoll_wait(epoll, &event, 1, 7);
  close(epoll);
}
static void by_epoll_pwait2(void) {
  const int epoll = epoll_of_pipe();
  struct epoll_event event;
  epoll_pwait2(epoll, &event, 1, &kLength, NULL);
  close(epoll);
}
static void by_socket_timeout(void) {
  char byte;
  setsockopt(sockets[0], SOL_SOCKET, SO_RCVTIMEO, &(struct timeval){0, 1234}, sizeof(struct timeval));
  recv(sockets[0], &byte, 1, 0);
  setsockopt(sockets[0], SOL_SOCKET, SO_RCVTIMEO, &(struct timeval){0, 0}, sizeof(struct timeval));
}
static void by_recvmmsg(void) {
  char byte;
  struct iovec part = {&byte, 1};
  struct mmsghdr message = {.msg_hdr = {.msg_iov = &part, .msg_iovlen = 1}};
  struct timespec timeout = kLength;
  recvmmsg(sockets[0], &message, 1, 0, &timeout);
}

// ---- what another thread ends after a while
static void* write_later(void* to) {
  nanosleep(&kLength, NULL);
  (void)!write(*(int*)to, "x", 1);
  return NULL;
}
static pthread_t start(void* (*function)(void*), void* argument) {
  pthread_t thread;
  pthread_create(&thread, NULL, function, argument);
  return thread;
}
void with(void* (*function)(void*), void* argument, void (*wait)(void)) {
  const pthread_t thread = start(function, argument);
  wait();
  pthread_join(thread, NULL);
}

static char taken;
static void take_from_pipe(void) { (void)!read(ends[0], &taken, 1); }
static void by_read(void) { with(write_later, &ends[1], take_from_pipe); }
static void take_from_socket(void) { recv(sockets[0], &taken, 1, 0); }
static void by_recv(void) { with(write_later, &sockets[1], take_from_socket); }
static void take_message(void) {
  struct iovec part = {&taken, 1};
  struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1};
  recvmsg(sockets[0], &message, 0);
}
static void by_recvmsg(void) { with(write_later, &sockets[1], take_message); }
static int event_descriptor;
static void* count_later(void* unused) {
  (void)unused;
  nanosleep(&kLength, NULL);
  eventfd_write(event_descriptor, 1);
  return NULL;
}
static void take_event(void) {
  uint64_t count;
  (void)!read(event_descriptor, &count, sizeof count);
}
static void by_eventfd(void) {
  event_descriptor = eventfd(0, 0);
  with(count_later, NULL, take_event);
  close(event_descriptor);
}

// ---- threads
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
static sem_t semaphore;
static pthread_barrier_t barrier;
static int is_told;
static atomic_int word;

static void* hold_mutex(void* unused) {
  (void)unused;
  pthread_mutex_lock(&mutex);
  nanosleep(&kLength, NULL);
  pthread_mutex_unlock(&mutex);
  return NULL;
}
/// The other one has it first.
static void let_others_begin(void) { usleep(0); nanosleep(&(struct timespec){0, 1}, NULL); }
static void take_mutex(void) {
  let_others_begin();
  pthread_mutex_lock(&mutex);
  pthread_mutex_unlock(&mutex);
}
static void by_mutex(void) { with(hold_mutex, NULL, take_mutex); }
static void* hold_mutex_for_long(void* unused) {
  (void)unused;
  pthread_mutex_lock(&mutex);
  nanosleep(&(struct timespec){0, 9000000}, NULL);
  pthread_mutex_unlock(&mutex);
  return NULL;
}
static Nanoseconds within;  // of a wait beside others
static void try_mutex(void) {
  let_others_begin();
  const Nanoseconds begin = read_clock(CLOCK_MONOTONIC);
  const struct timespec until = after(CLOCK_REALTIME, kShort);
  pthread_mutex_timedlock(&mutex, &until);
  within = read_clock(CLOCK_MONOTONIC) - begin;
}
static void by_mutex_timedlock(void) { with(hold_mutex_for_long, NULL, try_mutex); }
static void* tell(void* unused) {
  (void)unused;
  nanosleep(&kLength, NULL);
  pthread_mutex_lock(&mutex);
  is_told = 1;
  pthread_cond_signal(&condition);
  pthread_mutex_unlock(&mutex);
  return NULL;
}
static void hear(void) {
  pthread_mutex_lock(&mutex);
  is_told = 0;
  while (!is_told) pthread_cond_wait(&condition, &mutex);
  pthread_mutex_unlock(&mutex);
}
static void by_condition(void) { with(tell, NULL, hear); }
static void by_cond_timedwait(void) {
  const struct timespec until = after(CLOCK_REALTIME, kShort);
  pthread_mutex_lock(&mutex);
  pthread_cond_timedwait(&condition, &mutex, &until);
  pthread_mutex_unlock(&mutex);
}
static void by_cond_clockwait(void) {
  const struct timespec until = after(CLOCK_MONOTONIC, kShort);
  pthread_mutex_lock(&mutex);
  pthread_cond_clockwait(&condition, &mutex, CLOCK_MONOTONIC, &until);
  pthread_mutex_unlock(&mutex);
}
static void* hold_lock(void* unused) {
  (void)unused;
  pthread_rwlock_wrlock(&lock);
  nanosleep(&kLength, NULL);
  pthread_rwlock_unlock(&lock);
  return NULL;
}
static void take_read_lock(void) {
  let_others_begin();
  pthread_rwlock_rdlock(&lock);
  pthread_rwlock_unlock(&lock);
}
static void by_read_lock(void) { with(hold_lock, NULL, take_read_lock); }
static void take_write_lock(void) {
  let_others_begin();
  pthread_rwlock_wrlock(&lock);
  pthread_rwlock_unlock(&lock);
}
static void by_write_lock(void) { with(hold_lock, NULL, take_write_lock); }
static void* post(void* unused) {
  (void)unused;
  nanosleep(&kLength, NULL);
  sem_post(&semaphore);
  return NULL;
}
static void take_semaphore(void) { sem_wait(&semaphore); }
static void by_semaphore(void) { with(post, NULL, take_semaphore); }
static void by_sem_timedwait(void) {
  const struct timespec until = after(CLOCK_REALTIME, kShort);
  sem_timedwait(&semaphore, &until);
}
static void* reach_barrier(void* unused) {
  (void)unused;
  nanosleep(&kLength, NULL);
  pthread_barrier_wait(&barrier);
  return NULL;
}
static void wait_at_barrier(void) { pthread_barrier_wait(&barrier); }
static void by_barrier(void) { with(reach_barrier, NULL, wait_at_barrier); }
static void* only_sleep(void* unused) {
  (void)unused;
  nanosleep(&kLength, NULL);
  return NULL;
}
static void nothing(void) {}
static void by_join(void) { with(only_sleep, NULL, nothing); }
static int sleep_c11(void* unused) {
  (void)unused;
  return thrd_sleep(&kLength, NULL);
}
static void by_thrd_join(void) {
  thrd_t thread;
  thrd_create(&thread, sleep_c11, NULL);
  thrd_join(thread, NULL);
}
static void by_cnd_timedwait(void) {
  mtx_t m;
  cnd_t c;
  mtx_init(&m, mtx_plain);
  cnd_init(&c);
  struct timespec until;
  timespec_get(&until, TIME_UTC);
  until = to_timespec(until.tv_sec * 1000000000LL + until.tv_nsec + kShort);
  mtx_lock(&m);
  cnd_timedwait(&c, &m, &until);
  mtx_unlock(&m);
}
static void by_futex_timeout(void) {
  syscall(SYS_futex, &word, FUTEX_WAIT | FUTEX_PRIVATE_FLAG, atomic_load(&word), &kLength, NULL, 0);
}
static void* wake_word(void* unused) {
  (void)unused;
  nanosleep(&kLength, NULL);
  atomic_fetch_add(&word, 1);
  syscall(SYS_futex, &word, FUTEX_WAKE | FUTEX_PRIVATE_FLAG, 1, NULL, NULL, 0);
  return NULL;
}
static void wait_for_word(void) {
  syscall(SYS_futex, &word, FUTEX_WAIT | FUTEX_PRIVATE_FLAG, atomic_load(&word), NULL, NULL, 0);
}
/// The lock of a futex with priority inheritance is handed over.
static _Atomic uint32_t owner;
static long ask_owner(int operation, const struct timespec* until) {
  return syscall(SYS_futex, &owner, operation | FUTEX_PRIVATE_FLAG, 0, until, NULL, 0);
}
static void* own_for_a_while(void* unused) {
  (void)unused;
  check(ask_owner(FUTEX_LOCK_PI, NULL) == 0, "FUTEX_LOCK_PI");
  check(ask_owner(FUTEX_LOCK_PI, NULL) < 0 && errno == EDEADLK, "FUTEX_LOCK_PI twice");
  nanosleep(&kLength, NULL);
  check(ask_owner(FUTEX_UNLOCK_PI, NULL) == 0, "FUTEX_UNLOCK_PI");
  check(ask_owner(FUTEX_TRYLOCK_PI, NULL) < 0 && errno == EWOULDBLOCK, "who has waited has it");
  return NULL;
}
static void own_afterwards(void) {
  nanosleep(&(struct timespec){0, 1000}, NULL);
  check(ask_owner(FUTEX_UNLOCK_PI, NULL) < 0 && errno == EPERM, "FUTEX_UNLOCK_PI of another's");
  const struct timespec until = after(CLOCK_REALTIME, 1000);
  check(ask_owner(FUTEX_LOCK_PI, &until) < 0 && errno == ETIMEDOUT, "FUTEX_LOCK_PI until");
  check(ask_owner(FUTEX_LOCK_PI, NULL) == 0, "FUTEX_LOCK_PI of another's");
  check(ask_owner(FUTEX_UNLOCK_PI, NULL) == 0 && owner == 0, "FUTEX_UNLOCK_PI without others");
}
static void by_futex_of_owner(void) { with(own_for_a_while, NULL, own_afterwards); }
static void by_futex(void) { with(wake_word, NULL, wait_for_word); }

// ---- processes
static void by_waitpid(void) {
  const pid_t child = fork();
  if (child == 0) {
    nanosleep(&kLength, NULL);
    _exit(0);
  }
  waitpid(child, NULL, 0);
}
static void by_waitid(void) {
  const pid_t child = fork();
  if (child == 0) {
    nanosleep(&kLength, NULL);
    _exit(0);
  }
  siginfo_t info;
  waitid(P_PID, (id_t)child, &info, WEXITED);
}
static void by_system(void) { (void)!system("sleep 0.25"); }
static void by_popen(void) {
  char line[16];
  FILE* const stream = popen("sleep 0.25; echo done", "r");
  if (fgets(line, sizeof line, stream) == NULL || strcmp(line, "done\n") != 0) printf("popen: %s\n", line);
  pclose(stream);
}
static void by_spawn(void) {
  extern char** environ;
  char* const arguments[] = {"sleep", "0.25", NULL};
  pid_t child;
  posix_spawnp(&child, "sleep", NULL, NULL, arguments, environ);
  waitpid(child, NULL, 0);
}
static void by_pipe_of_child(void) {
  int pipe_of_child[2];
  (void)!pipe(pipe_of_child);
  const pid_t child = fork();
  if (child == 0) {
    nanosleep(&kLength, NULL);
    (void)!write(pipe_of_child[1], "x", 1);
    _exit(0);
  }
  (void)!read(pipe_of_child[0], &taken, 1);
  waitpid(child, NULL, 0);
}

// ---- signals and timers
static void on_signal(int signal) { (void)signal; }
static void by_sigtimedwait(void) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, NULL);
  sigtimedwait(&set, NULL, &kLength);
}
static void by_sigwait(void) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGALRM);
  sigprocmask(SIG_BLOCK, &set, NULL);
  setitimer(ITIMER_REAL, &(struct itimerval){{0, 0}, {0, 1234}}, NULL);
  int signal;
  sigwait(&set, &signal);
  sigprocmask(SIG_UNBLOCK, &set, NULL);
}
static void by_pause(void) {
  signal(SIGALRM, on_signal);
  setitimer(ITIMER_REAL, &(struct itimerval){{0, 0}, {0, 1234}}, NULL);
  pause();
}
static void by_alarm(void) {
  signal(SIGALRM, on_signal);
  alarm(1);
  sleep(5);
}
static void by_timerfd(void) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  timerfd_settime(timer, 0, &(struct itimerspec){{0, 0}, kLength}, NULL);
  uint64_t count;
  (void)!read(timer, &count, sizeof count);
  close(timer);
}
static void by_periodic_timerfd(void) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK);
  timerfd_settime(timer, 0, &(struct itimerspec){kLength, kLength}, NULL);
  for (int i = 0; i < 3; ++i) {
    uint64_t count;
    poll(&(struct pollfd){timer, POLLIN, 0}, 1, -1);
    (void)!read(timer, &count, sizeof count);
  }
  close(timer);
}
static void by_spinning(void) {
  const Nanoseconds end = read_clock(CLOCK_MONOTONIC) + kShort;
  while (read_clock(CLOCK_MONOTONIC) < end) continue;
}

static const struct Kind kinds[] = {
    {"nanosleep", by_nanosleep, 1234567},
    {"clock_nanosleep", by_clock_nanosleep, 1234567},
    {"clock_nanosleep until, monotonic", until_monotonic, 1234567},
    {"clock_nanosleep until, realtime", until_realtime, 1234567},
    {"usleep", by_usleep, 1234000},
    {"sleep", by_sleep, 1000000000},
    {"thrd_sleep", by_thrd_sleep, 1234567},
    {"nanosleep by syscall()", by_raw_nanosleep, 1234567},
    {"poll", by_poll, 7000000},
    {"ppoll", by_ppoll, 1234567},
    {"select", by_select, 1234000},
    {"pselect", by_pselect, 1234567},
    {"epoll_wait", by_epoll_wait, 7000000},
    {"epoll_pwait2", by_epoll_pwait2, 1234567},
    {"SO_RCVTIMEO", by_socket_timeout, 1234000},
    {"recvmmsg", by_recvmmsg, 1234567},
    {"read", by_read, 1234567},
    {"recv", by_recv, 1234567},
    {"recvmsg", by_recvmsg, 1234567},
    {"eventfd", by_eventfd, 1234567},
    {"pthread_mutex_lock", by_mutex, 1234567},
    {"pthread_mutex_timedlock", by_mutex_timedlock, 9000000},
    {"pthread_cond_wait", by_condition, 1234567},
    {"pthread_cond_timedwait", by_cond_timedwait, 1234567},
    {"pthread_cond_clockwait", by_cond_clockwait, 1234567},
    {"pthread_rwlock_rdlock", by_read_lock, 1234567},
    {"pthread_rwlock_wrlock", by_write_lock, 1234567},
    {"sem_wait", by_semaphore, 1234567},
    {"sem_timedwait", by_sem_timedwait, 1234567},
    {"pthread_barrier_wait", by_barrier, 1234567},
    {"pthread_join", by_join, 1234567},
    {"thrd_join", by_thrd_join, 1234567},
    {"cnd_timedwait", by_cnd_timedwait, 1234567},
    {"futex until", by_futex_timeout, 1234567},
    {"futex", by_futex, 1234567},
    {"futex, FUTEX_LOCK_PI", by_futex_of_owner, 1234567},
    {"waitpid", by_waitpid, 1234567},
    {"waitid", by_waitid, 1234567},
    {"system", by_system, 250000000},
    {"popen", by_popen, 250000000},
    {"posix_spawn", by_spawn, 250000000},
    {"pipe of a child", by_pipe_of_child, 1234567},
    {"sigtimedwait", by_sigtimedwait, 1234567},
    {"sigwait", by_sigwait, 1234000},
    {"pause", by_pause, 1234000},
    {"alarm", by_alarm, 1000000000},
    {"timerfd", by_timerfd, 1234567},
    {"timerfd, periodic", by_periodic_timerfd, 3 * 1234567},
    {"spinning on the clock", by_spinning, 0},
};

static void run(const struct Kind* all, size_t size, const char* only) {
  for (size_t i = 0; i < size; ++i) {
    if (only != NULL && strcmp(only, all[i].name) != 0) continue;
    const Nanoseconds begin = read_clock(CLOCK_MONOTONIC);
    all[i].wait();
    const Nanoseconds length = read_clock(CLOCK_MONOTONIC) - begin;
    printf("%s: %lld %lld\n", all[i].name, (long long)length, (long long)all[i].expected);
    fflush(stdout);
  }
}

int main(int count, char** arguments) {
  (void)!pipe(ends);
  socketpair(AF_UNIX, SOCK_DGRAM, 0, sockets);
  sem_init(&semaphore, 0, 0);
  pthread_barrier_init(&barrier, NULL, 2);
  const char* const only = count > 1 ? arguments[1] : NULL;
  run(kinds, sizeof kinds / sizeof *kinds, only);
  run(timer_kinds, timer_kinds_count, only);
  run(object_kinds, object_kinds_count, only);
  run(file_kinds, file_kinds_count, only);
  if (only == NULL)
    printf("within pthread_mutex_timedlock: %lld %lld\n", (long long)within, (long long)kShort);
  return 0;
}
