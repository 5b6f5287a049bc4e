/* What a load did and got: a CSV file of every event, and `key: value` lines at the end.
 *
 *   event     wall_ns: CLOCK_REALTIME, mono_ns: CLOCK_MONOTONIC, and
 *   created   writer: the program's number; topic: what it subscribes to
 *   readers   number: of remote ones that the publisher knows from now on
 *   writers   number: of remote ones that the subscriber knows from now on
 *   write     writer, number, size; took_ns of the call; ok: whether it succeeded. The times are
 * its start. receive   writer, number, size; stamp_ns: CLOCK_REALTIME of the writer's program at
 * the write
 *
 * Its calls may come from any thread. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "options.h"

#ifdef __cplusplus
extern "C" {
#endif

int64_t wall_ns(void);      /* CLOCK_REALTIME */
int64_t monotonic_ns(void); /* CLOCK_MONOTONIC */

/* Ends the program with status 1 if the file cannot be written. The options must outlive all. */
void open_journal(const Options* options);
void note_created(void);
/* Remote readers that the publisher, or writers that the subscriber knows, came or went. */
void note_matched(bool publisher, int change);
void note_write(uint64_t number, int64_t wall, int64_t mono, bool ok);
void note_receive(uint32_t writer, uint64_t number, uint32_t size, int64_t stamp);

/* Waits until as many are matched as --until-matched says, or until monotonic time `end`.
 * @return whether they are. */
bool await_matched(int64_t end);
/* Sleeps until monotonic time `at`. */
void sleep_until(int64_t at);
/* Whether SIGINT or SIGTERM came. */
bool is_interrupted(void);
/* Prints the totals. @return the exit status: 0, or 3 if too few were matched and its patience had
 * no end. */
int close_journal(void);

/* Writes samples by `write(context, number, written_ns)` at the rate asked for until all are
 * written or the time is over, then waits until then. A write that takes long delays the next ones;
 * none is left out. */
void run_load(bool (*write)(void* context, uint64_t number, int64_t written_ns), void* context);

#ifdef __cplusplus
}
#endif
