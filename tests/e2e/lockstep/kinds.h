// What the tables of waits have in common: see waits.c.
#pragma once
#define _GNU_SOURCE
#include <pthread.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

typedef int64_t Nanoseconds;

struct Kind {
  const char* name;
  void (*wait)(void);
  Nanoseconds expected;  // 0: the time is printed, and what it is to be not known here
};

extern const struct Kind timer_kinds[], object_kinds[], file_kinds[];
extern const size_t timer_kinds_count, object_kinds_count, file_kinds_count;

static const Nanoseconds kShort = 1234567;  // ns: of a wait that ends by its time
static const struct timespec kLength = {0, 1234567};

Nanoseconds read_clock(clockid_t clock);
struct timespec to_timespec(Nanoseconds time);
struct timespec after(clockid_t clock, Nanoseconds length);

// Says that something else than the time is wrong.
void check(int is_right, const char* what);

// Waits while another thread runs.
void with(void* (*function)(void*), void* argument, void (*wait)(void));
