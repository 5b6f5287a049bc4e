#include "journal.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const Options* options;
static FILE* csv;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int64_t created;
static int known[2]; /* by the subscriber, the publisher */
static bool was_matched;
static double matched_after; /* s */
static uint64_t written, failed, received, received_bytes;
static volatile sig_atomic_t interrupted;

static int64_t now(clockid_t clock) {
  struct timespec time;
  clock_gettime(clock, &time);
  return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

int64_t wall_ns(void) { return now(CLOCK_REALTIME); }
int64_t monotonic_ns(void) { return now(CLOCK_MONOTONIC); }

static void on_signal(int number) {
  (void)number;
  interrupted = 1;
}

bool is_interrupted(void) { return interrupted != 0; }

void open_journal(const Options* of) {
  options = of;
  const struct sigaction action = {.sa_handler = on_signal};
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
  if (options->csv == NULL) return;
  csv = fopen(options->csv, "w");
  if (csv == NULL) {
    perror(options->csv);
    exit(1);
  }
  fputs("event,topic,wall_ns,mono_ns,writer,number,size,took_ns,ok,stamp_ns\n", csv);
}

void note_created(void) {
  created = monotonic_ns();
  if (csv != NULL)
    fprintf(csv, "created,%s,%" PRId64 ",%" PRId64 ",%u,,,,,\n",
            options->subscribe == NULL ? "" : options->subscribe, wall_ns(), created,
            options->writer);
  printf("created_ns: %" PRId64 "\n", wall_ns());
  fflush(stdout);
}

static bool are_matched(void) {
  const int wanted = (int)options->until_matched;
  return (options->publish == NULL || known[1] >= wanted) &&
         (options->subscribe == NULL || known[0] >= wanted);
}

void note_matched(bool publisher, int change) {
  const int64_t mono = monotonic_ns(), wall = wall_ns();
  pthread_mutex_lock(&mutex);
  known[publisher] += change;
  if (csv != NULL)
    fprintf(csv, "%s,%s,%" PRId64 ",%" PRId64 ",%u,%d,,,,\n", publisher ? "readers" : "writers",
            publisher ? options->publish : options->subscribe, wall, mono, options->writer,
            known[publisher]);
  if (!was_matched && are_matched()) {
    was_matched = true;
    matched_after = (double)(mono - created) * 1e-9;
    printf("matched_ns: %" PRId64 "\n", wall);
    fflush(stdout);
  }
  pthread_mutex_unlock(&mutex);
}

void note_write(uint64_t number, int64_t wall, int64_t mono, bool ok) {
  const int64_t took = monotonic_ns() - mono;
  pthread_mutex_lock(&mutex);
  *(ok ? &written : &failed) += 1;
  if (csv != NULL)
    fprintf(csv, "write,%s,%" PRId64 ",%" PRId64 ",%u,%" PRIu64 ",%u,%" PRId64 ",%d,\n",
            options->publish, wall, mono, options->writer, number, options->size, took, ok);
  pthread_mutex_unlock(&mutex);
}

void note_receive(uint32_t writer, uint64_t number, uint32_t size, int64_t stamp) {
  const int64_t mono = monotonic_ns(), wall = wall_ns();
  pthread_mutex_lock(&mutex);
  ++received;
  received_bytes += size;
  if (csv != NULL)
    fprintf(csv, "receive,%s,%" PRId64 ",%" PRId64 ",%u,%" PRIu64 ",%u,,,%" PRId64 "\n",
            options->subscribe, wall, mono, writer, number, size, stamp);
  pthread_mutex_unlock(&mutex);
}

void sleep_until(int64_t at) {
  const struct timespec time = {.tv_sec = at / 1000000000, .tv_nsec = at % 1000000000};
  while (!is_interrupted() &&
         clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, NULL) == EINTR) {
  }
}

bool await_matched(int64_t end) {
  const int64_t step = 1000000; /* 1 ms */
  while (true) {
    pthread_mutex_lock(&mutex);
    const bool matched = was_matched;
    pthread_mutex_unlock(&mutex);
    if (matched || is_interrupted() || monotonic_ns() >= end) return matched;
    sleep_until(monotonic_ns() + step);
  }
}

/* The first time from `earliest` on that has the phase asked for. */
static int64_t in_phase(int64_t earliest) {
  if (options->phase < 0) return earliest;
  const double period = 1e9 / options->rate, phase = 1e9 * options->phase;
  return (int64_t)(phase + period * ceil(((double)earliest - phase) / period));
}

/* Samples number 0, 1, ... at their times, until all are written or time `end`. */
static void write_all(bool (*write)(void*, uint64_t, int64_t), void* context, int64_t start,
                      int64_t end) {
  for (uint64_t i = 0; options->count == 0 || i < options->count; ++i) {
    const int64_t due = start + (int64_t)((double)i * 1e9 / options->rate);
    sleep_until(due < end ? due : end);
    if (is_interrupted() || monotonic_ns() >= end) break;
    const int64_t wall = wall_ns(), mono = monotonic_ns();
    note_write(i, wall, mono, write(context, i, wall));
  }
}

/* Keeps the file up to date meanwhile: the program may be killed. */
static void wait_until(int64_t end) {
  const int64_t step = 200000000; /* 200 ms */
  while (!is_interrupted() && monotonic_ns() < end) {
    const int64_t next = monotonic_ns() + step;
    sleep_until(next < end ? next : end);
    pthread_mutex_lock(&mutex);
    if (csv != NULL) fflush(csv);
    pthread_mutex_unlock(&mutex);
  }
}

void run_load(bool (*write)(void*, uint64_t, int64_t), void* context) {
  int64_t end = created + (int64_t)(options->seconds * 1e9);
  const int64_t patience = created + (int64_t)(options->patience * 1e9);
  if (options->until_matched > 0) await_matched(patience < end ? patience : end);
  if (options->publish != NULL && monotonic_ns() < end) {
    const int64_t settle = options->until_matched == 0 ? 0 : (int64_t)(options->settle * 1e9);
    write_all(write, context, in_phase(monotonic_ns() + settle), end);
    const int64_t linger = monotonic_ns() + (int64_t)(options->linger * 1e9);
    if (options->linger >= 0 && linger < end) end = linger;
  }
  wait_until(end);
}

int close_journal(void) {
  pthread_mutex_lock(&mutex);
  if (was_matched) printf("matched_s: %.6f\n", matched_after);
  printf("known_readers: %d\nknown_writers: %d\n", known[1], known[0]);
  printf("written: %" PRIu64 "\nwrite_failed: %" PRIu64 "\nreceived: %" PRIu64
         "\nreceived_bytes: %" PRIu64 "\n",
         written, failed, received, received_bytes);
  const bool lost = csv != NULL && fclose(csv) != 0;
  csv = NULL;
  const bool alone =
      options->until_matched > 0 && !was_matched && options->patience >= options->seconds;
  pthread_mutex_unlock(&mutex);
  if (lost) perror(options->csv);
  return lost ? 1 : alone ? 3 : 0;
}
