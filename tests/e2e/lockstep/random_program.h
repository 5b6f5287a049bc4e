// A plan of random steps, and what carries it out: see random_program.c.
#ifndef BARAKA_TESTS_E2E_LOCKSTEP_RANDOM_PROGRAM_H
#define BARAKA_TESTS_E2E_LOCKSTEP_RANDOM_PROGRAM_H

#include <stdint.h>

typedef int64_t Nanoseconds;

enum {
  kMostProcesses = 4,
  kMostThreads = 16,
  kMostSteps = 48,
  kMostArguments = 3,
  kMostRecords = 8192
};

/// One step of a thread. @return what is logged: a result, or -errno.
typedef int64_t (*Action)(const int64_t* arguments);

struct Step {
  Action action;
  int64_t arguments[kMostArguments];
};

struct ThreadPlan {
  int process;  ///< Whose thread it is; thread 0 is the first of process 0.
  int steps;
  struct Step all[kMostSteps];
};

struct Plan {
  long number;
  struct ThreadPlan threads[kMostThreads];
};

extern struct Plan plan;

/// Descriptors that all processes of a plan share, and timers, which each process has of its own.
enum {
  kPipe0,
  kPipe1,
  kSmallPipe,
  kStream,
  kDatagrams,
  kEvent0,
  kEvent1,
  kLoopback,
  kAir,
  kTimer0,
  kTimer1,
  kDescriptors
};
/// What is read from, and written to.
extern int readable[kDescriptors], writable[kDescriptors];

/// The action of a name; null: there is none.
Action action_of(const char* name);

/// What a thread does: its steps, each of which is logged. @return what its process ends with.
int carry_out(int thread);

/// Once in each process: its own mutexes, semaphores, timers ... @param first  its first thread
void begin_process(int first);

/// One line of the log: virtual time, thread, step, result. Step -1: a handler of this signal.
void add_record(int thread, int step, int64_t result);

Nanoseconds virtual_time(void);

#endif
