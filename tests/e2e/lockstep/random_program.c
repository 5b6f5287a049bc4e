// Carries out plans of random steps, one after the other, each in a process of its own, and prints
// when each step of which thread ended, and how, in that order:
//
//   random_program FILE ADDRESS TIME  the plans of a file, from 1 s on; ADDRESS: of who answers,
//   over
//                                     the air; TIME, s: when it is asked first
//   random_program answer             who answers: sends back what it receives
//
// The plans are drawn, and the log is foreseen, by tests/e2e/lockstep_plans.py.
#define _GNU_SOURCE
#include "random_program.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static const Nanoseconds kUptime = 1000000000000;  // what CLOCK_MONOTONIC says when a run begins
static const Nanoseconds kBegin = 1000000000;

struct Record {
  Nanoseconds time;
  int thread, step;
  int64_t result;
};

/// Shared by the processes of a plan.
struct Log {
  atomic_int count;
  struct Record all[kMostRecords];
};

struct Plan plan;
int readable[kDescriptors], writable[kDescriptors];
static struct Log* records;

Nanoseconds virtual_time(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000000000LL + now.tv_nsec - kUptime;
}

void add_record(int thread, int step, int64_t result) {
  const Nanoseconds now = virtual_time();
  const int i = atomic_fetch_add(&records->count, 1);
  if (i < kMostRecords) records->all[i] = (struct Record){now, thread, step, result};
}

static void fail(const char* what) {
  fprintf(stderr, "random_program: %s: %s\n", what, strerror(errno));
  exit(1);
}

static void read_line(const char* line, int* thread) {
  char name[32];
  int64_t a[kMostArguments] = {0};
  int number, process;
  if (sscanf(line, "thread %d %d", &number, &process) == 2) {
    plan.threads[*thread = number].process = process;
    return;
  }
  if (sscanf(line, "%31s %ld %ld %ld", name, &a[0], &a[1], &a[2]) < 1) return;
  struct ThreadPlan* const of = &plan.threads[*thread];
  struct Step* const step = &of->all[of->steps++];
  step->action = action_of(name);
  if (step->action == NULL || of->steps == kMostSteps) {
    errno = EINVAL;
    fail(line);
  }
  memcpy(step->arguments, a, sizeof a);
}

/// The whole file, which is closed: processes would share the place up to which it is read.
static char* read_file(const char* name) {
  FILE* const file = fopen(name, "re");
  if (file == NULL) fail(name);
  size_t length = 0, size = 1 << 16;
  char* text = malloc(size);
  while (text != NULL) {
    length += fread(text + length, 1, size - length - 1, file);
    if (feof(file)) break;
    text = realloc(text, size *= 2);
  }
  if (text == NULL) fail(name);
  text[length] = 0;
  fclose(file);
  return text;
}

/// @return what follows the plan; null: there is none.
static char* read_plan(char* text) {
  static const char kNext[] = "plan ";
  memset(&plan, 0, sizeof plan);
  if (strncmp(text, kNext, sizeof kNext - 1) != 0) return NULL;
  plan.number = strtol(text + sizeof kNext - 1, &text, 10);
  int thread = 0;
  for (char* end; (end = strchr(text, '\n')) != NULL; text = end + 1) {
    if (strncmp(text, kNext, sizeof kNext - 1) == 0) break;
    *end = 0;
    read_line(text, &thread);
  }
  return text;
}

static void open_pipe(int which, int size) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
  if (size > 0 && fcntl(ends[1], F_SETPIPE_SZ, size) != size) fail("F_SETPIPE_SZ");
  readable[which] = ends[0];
  writable[which] = ends[1];
}

static void open_pair(int which, int type) {
  int ends[2];
  if (socketpair(AF_UNIX, type | SOCK_CLOEXEC, 0, ends) != 0) fail("socketpair");
  readable[which] = ends[0];
  writable[which] = ends[1];
}

static struct sockaddr_in address_of(const char* text, int port) {
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
  inet_pton(AF_INET, text, &address.sin_addr);
  return address;
}

static int datagram_socket(const char* own, int port) {
  const struct sockaddr_in address = address_of(own, port);
  const int made = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (made < 0 || bind(made, (const struct sockaddr*)&address, sizeof address) != 0) fail("socket");
  return made;
}

static void connect_to(int which, const char* text, int port) {
  const struct sockaddr_in address = address_of(text, port);
  if (connect(which, (const struct sockaddr*)&address, sizeof address) != 0) fail("connect");
}

/// Those of one plan; kAir stays.
static void open_descriptors(void) {
  open_pipe(kPipe0, 0);
  open_pipe(kPipe1, 0);
  open_pipe(kSmallPipe, 4096);
  open_pair(kStream, SOCK_STREAM);
  open_pair(kDatagrams, SOCK_DGRAM);
  readable[kEvent0] = writable[kEvent0] = eventfd(0, EFD_CLOEXEC);
  readable[kEvent1] = writable[kEvent1] = eventfd(0, EFD_CLOEXEC | EFD_SEMAPHORE);
  // A process whose parent was killed may have those of an earlier plan for a while.
  const int port = 10000 + 2 * (int)(plan.number % 10000);
  readable[kLoopback] = datagram_socket("127.0.0.1", port);
  writable[kLoopback] = datagram_socket("127.0.0.1", port + 1);
  connect_to(writable[kLoopback], "127.0.0.1", port);
}

static void close_descriptors(void) {
  for (int i = 0; i < kAir; ++i) {
    if (writable[i] != readable[i]) close(writable[i]);
    close(readable[i]);
  }
}

static void sleep_until(Nanoseconds time) {
  const Nanoseconds at = time + kUptime;
  const struct timespec until = {at / 1000000000, at % 1000000000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
}

/// The first packet waits for the other station's address.
static void get_ready(const char* other, Nanoseconds time) {
  char byte;
  readable[kAir] = writable[kAir] = datagram_socket("0.0.0.0", 6000);
  connect_to(readable[kAir], other, 5000);
  sleep_until(time);
  if (send(readable[kAir], "w", 1, 0) != 1 || recv(readable[kAir], &byte, 1, 0) != 1) fail("ask");
  sleep_until(kBegin);
}

static void print_log(int status) {
  printf("plan %ld %d\n", plan.number, status);
  for (int i = 0; i < atomic_load(&records->count) && i < kMostRecords; ++i) {
    const struct Record* const one = &records->all[i];
    printf("%ld %d %d %ld\n", one->time, one->thread, one->step, one->result);
  }
}

/// The run has ended before the plan: what has happened so far.
static void on_end_of_run(int signal) {
  print_log(-signal);
  fflush(stdout);
  _exit(1);
}

static void carry_out_plan(void) {
  atomic_store(&records->count, 0);
  open_descriptors();
  fflush(stdout);
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    signal(SIGTERM, SIG_DFL);
    begin_process(0);
    _exit(carry_out(0));
  }
  int status;
  if (waitpid(child, &status, 0) != child) fail("waitpid");
  close_descriptors();
  print_log(status);
}

static void answer(void) {
  const int own = datagram_socket("0.0.0.0", 5000);
  for (;;) {
    char bytes[2000];
    struct sockaddr_in from;
    socklen_t length = sizeof from;
    const ssize_t count = recvfrom(own, bytes, sizeof bytes, 0, (struct sockaddr*)&from, &length);
    if (count > 0) sendto(own, bytes, (size_t)count, 0, (const struct sockaddr*)&from, length);
  }
}

int main(int count, char** words) {
  if (count == 2 && strcmp(words[1], "answer") == 0) answer();
  if (count < 4) return 2;
  char* text = read_file(words[1]);
  records = mmap(NULL, sizeof *records, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (records == MAP_FAILED) fail("mmap");
  setvbuf(stdout, NULL, _IOFBF, 1 << 20);
  get_ready(words[2], (Nanoseconds)(strtod(words[3], NULL) * 1e9));
  signal(SIGTERM, on_end_of_run);
  while ((text = read_plan(text)) != NULL) carry_out_plan();
  printf("done\n");
  return 0;
}
