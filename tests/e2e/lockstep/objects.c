// Waits for objects that threads and processes share, and of C11.
#include "kinds.h"

#include <errno.h>
#include <fcntl.h>
#include <mqueue.h>
#include <poll.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

static void rest(void) { nanosleep(&kLength, NULL); }

/// A child that does this after a while.
static pid_t child_that(void (*does)(void)) {
  const pid_t child = fork();
  if (child != 0) return child;
  rest();
  does();
  _exit(0);
}
static void beside(void (*other)(void), void (*wait)(void)) {
  const pid_t child = child_that(other);
  wait();
  waitpid(child, NULL, 0);
}

// ---- semaphores of System V
static int set;

static int change(short by, short flags) {
  return semop(set, &(struct sembuf){0, by, flags}, 1);
}
static void give(void) { change(1, 0); }
static void take(void) { check(change(-1, 0) == 0, "semop"); }
static void by_semop(void) {
  set = semget(IPC_PRIVATE, 1, 0600);
  beside(give, take);
  semctl(set, 0, IPC_RMID);
}
static void until_zero(void) { check(change(0, 0) == 0, "semop for 0"); }
static void by_semop_for_zero(void) {
  set = semget(IPC_PRIVATE, 1, 0600);
  give();
  beside(take, until_zero);
  semctl(set, 0, IPC_RMID);
}
static void by_semtimedop(void) {
  set = semget(IPC_PRIVATE, 1, 0600);
  const int status = semtimedop(set, &(struct sembuf){0, -1, 0}, 1, &kLength);
  check(status < 0 && errno == EAGAIN, "semtimedop");
  semctl(set, 0, IPC_RMID);
}
/// SEM_UNDO: the end of a process gives it back.
static void by_undo(void) {
  set = semget(IPC_PRIVATE, 1, 0600);
  give();
  const pid_t child = fork();
  if (child == 0) {
    change(-1, SEM_UNDO);
    rest();
    _exit(0);
  }
  nanosleep(&(struct timespec){0, 1000}, NULL);
  take();
  waitpid(child, NULL, 0);
  semctl(set, 0, IPC_RMID);
}

// ---- message queues of System V
struct Message {
  long type;
  char text[8192];
};
static int queue;

static void say(void) {
  msgsnd(queue, &(struct Message){3, "here"}, sizeof "here", 0);
}
static void hear(void) {
  struct Message message;
  check(msgrcv(queue, &message, sizeof message.text, 3, 0) == sizeof "here", "msgrcv");
}
static void by_msgrcv(void) {
  queue = msgget(IPC_PRIVATE, 0600);
  beside(say, hear);
  msgctl(queue, IPC_RMID, NULL);
}
static void say_much(void) {
  static const struct Message much = {3, ""};
  check(msgsnd(queue, &much, sizeof much.text, 0) == 0, "msgsnd");
}
static void take_one(void) {
  static struct Message message;
  msgrcv(queue, &message, sizeof message.text, 0, 0);
}
static void by_msgsnd(void) {
  static const struct Message much = {3, ""};
  queue = msgget(IPC_PRIVATE, 0600);
  while (msgsnd(queue, &much, sizeof much.text, IPC_NOWAIT) == 0) continue;
  beside(take_one, say_much);
  msgctl(queue, IPC_RMID, NULL);
}

// ---- message queues of POSIX
static mqd_t letters;

static void open_letters(void) {
  letters = mq_open("/letters", O_RDWR | O_CREAT, 0600, &(struct mq_attr){.mq_maxmsg = 1, .mq_msgsize = 8});
  check(letters >= 0, "mq_open");
}
static void close_letters(void) {
  mq_close(letters);
  mq_unlink("/letters");
}
static void post_letter(void) { mq_send(letters, "x", 1, 0); }
static void get_letter(void) {
  char text[8];
  check(mq_receive(letters, text, sizeof text, NULL) == 1, "mq_receive");
}
static void by_mq_receive(void) {
  open_letters();
  beside(post_letter, get_letter);
  close_letters();
}
static void get_one(void) {
  char text[8];
  mq_receive(letters, text, sizeof text, NULL);
}
static void send_letter(void) { check(mq_send(letters, "y", 1, 0) == 0, "mq_send"); }
static void by_mq_send(void) {
  open_letters();
  post_letter();
  beside(get_one, send_letter);
  close_letters();
}
static void by_mq_timedreceive(void) {
  open_letters();
  const struct timespec until = after(CLOCK_REALTIME, kShort);
  char text[8];
  check(mq_timedreceive(letters, text, sizeof text, NULL, &until) < 0 && errno == ETIMEDOUT, "mq_timedreceive");
  close_letters();
}
static void by_mq_timedsend(void) {
  open_letters();
  post_letter();
  const struct timespec until = after(CLOCK_REALTIME, kShort);
  check(mq_timedsend(letters, "x", 1, 0, &until) < 0 && errno == ETIMEDOUT, "mq_timedsend");
  close_letters();
}
static void await_letter(void) {
  check(poll(&(struct pollfd){letters, POLLIN, 0}, 1, -1) == 1, "poll of a message queue");
}
static void by_poll_of_queue(void) {
  open_letters();
  beside(post_letter, await_letter);
  close_letters();
}
static void on_signal(int signal) { (void)signal; }
static void await_notice(void) { pause(); }
static void by_mq_notify(void) {
  open_letters();
  signal(SIGUSR2, on_signal);
  mq_notify(letters, &(struct sigevent){.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGUSR2});
  beside(post_letter, await_notice);
  close_letters();
}

// ---- C11
static mtx_t mutex;
static cnd_t condition;
static int count;
static once_flag flag;

static int hold_for_long(void* unused) {
  (void)unused;
  mtx_lock(&mutex);
  thrd_sleep(&(struct timespec){0, 9000000}, NULL);
  mtx_unlock(&mutex);
  return 0;
}
static void after_another(thrd_start_t first, void (*wait)(void)) {
  thrd_t thread;
  thrd_create(&thread, first, NULL);
  thrd_sleep(&(struct timespec){0, 1}, NULL);
  wait();
  thrd_join(thread, NULL);
}
static void lock_c11(void) {
  mtx_lock(&mutex);
  mtx_unlock(&mutex);
}
static void by_mtx_lock(void) {
  mtx_init(&mutex, mtx_plain);
  after_another(hold_for_long, lock_c11);
}
static void try_c11(void) {
  struct timespec until = after(CLOCK_REALTIME, kShort);
  const Nanoseconds begin = read_clock(CLOCK_MONOTONIC);
  check(mtx_timedlock(&mutex, &until) == thrd_timedout, "mtx_timedlock");
  check(read_clock(CLOCK_MONOTONIC) - begin == kShort, "the time of mtx_timedlock");
}
static void by_mtx_timedlock(void) {
  mtx_init(&mutex, mtx_timed);
  after_another(hold_for_long, try_c11);
}
static int tell_one(void* unused) {
  (void)unused;
  thrd_sleep(&kLength, NULL);
  mtx_lock(&mutex);
  ++count;
  cnd_signal(&condition);
  mtx_unlock(&mutex);
  return 0;
}
static int tell_all(void* unused) {
  (void)unused;
  thrd_sleep(&kLength, NULL);
  mtx_lock(&mutex);
  ++count;
  cnd_broadcast(&condition);
  mtx_unlock(&mutex);
  return 0;
}
static int hear_c11(void* unused) {
  (void)unused;
  mtx_lock(&mutex);
  while (count == 0) cnd_wait(&condition, &mutex);
  mtx_unlock(&mutex);
  return 0;
}
static void hear_here(void) { hear_c11(NULL); }
static void prepare_condition(void) {
  mtx_init(&mutex, mtx_plain);
  cnd_init(&condition);
  count = 0;
}
static void by_cnd_wait(void) {
  prepare_condition();
  after_another(tell_one, hear_here);
}
static void by_cnd_broadcast(void) {
  prepare_condition();
  thrd_t others[2];
  for (int i = 0; i < 2; ++i) thrd_create(&others[i], hear_c11, NULL);
  after_another(tell_all, hear_here);
  for (int i = 0; i < 2; ++i) thrd_join(others[i], NULL);
}
static void begin_slowly(void) { rest(); }
static int begin_first(void* unused) {
  (void)unused;
  call_once(&flag, begin_slowly);
  return 0;
}
static void begin_second(void) { call_once(&flag, begin_slowly); }
static void by_call_once(void) {
  flag = (once_flag)ONCE_FLAG_INIT;
  after_another(begin_first, begin_second);
}

// ---- of the GNU C library
static void by_sem_clockwait(void) {
  sem_t semaphore;
  sem_init(&semaphore, 0, 0);
  const struct timespec until = after(CLOCK_MONOTONIC, kShort);
  check(sem_clockwait(&semaphore, CLOCK_MONOTONIC, &until) < 0 && errno == ETIMEDOUT, "sem_clockwait");
}
static void* sleep_for_long(void* unused) {
  (void)unused;
  nanosleep(&(struct timespec){0, 9000000}, NULL);
  return NULL;
}
static void by_timedjoin(void) {
  pthread_t thread;
  pthread_create(&thread, NULL, sleep_for_long, NULL);
  const struct timespec until = after(CLOCK_REALTIME, kShort);
  check(pthread_timedjoin_np(thread, NULL, &until) == ETIMEDOUT, "pthread_timedjoin_np");
  pthread_detach(thread);
}
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
static void* hold_lock(void* unused) {
  (void)unused;
  pthread_rwlock_rdlock(&lock);
  nanosleep(&(struct timespec){0, 9000000}, NULL);
  pthread_rwlock_unlock(&lock);
  return NULL;
}
static void try_lock(void) {
  nanosleep(&(struct timespec){0, 1}, NULL);
  const struct timespec until = after(CLOCK_MONOTONIC, kShort);
  const Nanoseconds begin = read_clock(CLOCK_MONOTONIC);
  check(pthread_rwlock_clockwrlock(&lock, CLOCK_MONOTONIC, &until) == ETIMEDOUT, "pthread_rwlock_clockwrlock");
  check(read_clock(CLOCK_MONOTONIC) - begin == kShort, "the time of pthread_rwlock_clockwrlock");
}
static void by_rwlock_clockwrlock(void) { with(hold_lock, NULL, try_lock); }

// ---- threads that are cancelled
static int silent[2];
static void* sleep_for_ever(void* unused) {
  sleep(1000);
  return unused;
}
static void* read_for_ever(void* unused) {
  char byte;
  (void)!read(silent[0], &byte, 1);
  return unused;
}
static pthread_mutex_t guard = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t never = PTHREAD_COND_INITIALIZER;
static void give_guard(void* unused) {
  (void)unused;
  pthread_mutex_unlock(&guard);
}
static void* wait_for_ever(void* unused) {
  pthread_mutex_lock(&guard);
  pthread_cleanup_push(give_guard, NULL);
  for (;;) pthread_cond_wait(&never, &guard);
  pthread_cleanup_pop(1);
  return unused;
}
static void cancel(void* (*function)(void*)) {
  pthread_t thread;
  pthread_create(&thread, NULL, function, NULL);
  rest();
  pthread_cancel(thread);
  void* result = NULL;
  pthread_join(thread, &result);
  check(result == PTHREAD_CANCELED, "pthread_cancel");
}
static void by_cancelled_sleep(void) { cancel(sleep_for_ever); }
static void by_cancelled_read(void) {
  (void)!pipe(silent);
  cancel(read_for_ever);
}
static void by_cancelled_condition(void) {
  cancel(wait_for_ever);
  check(pthread_mutex_trylock(&guard) == 0, "its mutex is given back");
}

const struct Kind object_kinds[] = {
    {"semop", by_semop, 1234567},
    {"semop for 0", by_semop_for_zero, 1234567},
    {"semtimedop", by_semtimedop, 1234567},
    {"semop, SEM_UNDO", by_undo, 1234567},
    {"msgrcv", by_msgrcv, 1234567},
    {"msgsnd", by_msgsnd, 1234567},
    {"mq_receive", by_mq_receive, 1234567},
    {"mq_send", by_mq_send, 1234567},
    {"mq_timedreceive", by_mq_timedreceive, 1234567},
    {"mq_timedsend", by_mq_timedsend, 1234567},
    {"mq, poll", by_poll_of_queue, 1234567},
    {"mq_notify", by_mq_notify, 1234567},
    {"mtx_lock", by_mtx_lock, 9000000},
    {"mtx_timedlock", by_mtx_timedlock, 9000000},
    {"cnd_wait", by_cnd_wait, 1234567},
    {"cnd_broadcast", by_cnd_broadcast, 1234567},
    {"call_once", by_call_once, 1234567},
    {"sem_clockwait", by_sem_clockwait, 1234567},
    {"pthread_timedjoin_np", by_timedjoin, 1234567},
    {"pthread_cancel of a sleep", by_cancelled_sleep, 1234567},
    {"pthread_cancel of a read", by_cancelled_read, 1234567},
    {"pthread_cancel of a condition", by_cancelled_condition, 1234567},
    {"pthread_rwlock_clockwrlock", by_rwlock_clockwrlock, 9000000},
};
const size_t object_kinds_count = sizeof object_kinds / sizeof *object_kinds;
