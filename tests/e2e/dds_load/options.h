/* The command line of both loads, see kUsage in options.c. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { kAsConfigured, kBestEffort, kReliable } Reliability;

/* Text belongs to the command line. What is 0 (or kAsConfigured) was not given: the middleware's
 * default or what its configuration file says. */
typedef struct {
  const char* publish;   /* topic, or NULL */
  const char* subscribe; /* topic, or NULL */
  const char* csv;       /* file, or NULL */
  uint32_t domain;
  uint32_t writer;
  uint32_t size;  /* bytes of a sample's sequence */
  double rate;    /* Hz */
  uint64_t count; /* samples; 0: as many as there is time for */
  Reliability reliability;
  uint32_t keep_last;
  bool keep_all;
  double blocking; /* s that a reliable write may wait for room; 0: not given */
  uint32_t
      until_matched; /* programs that publisher and subscriber must know before the first write */
  double patience;   /* s from the start after which it writes though fewer are matched */
  double settle;     /* s from then on until the first write: the others may know less */
  double phase;      /* s, within a period of the monotonic clock, of writes; below 0: not given */
  double linger;     /* s from its last write until the end; below 0: not given */
  double seconds;    /* after which the program ends */
} Options;

/* Ends the program with status 2 and a message if something is wrong. */
Options read_options(int argc, char** argv);

#ifdef __cplusplus
}
#endif
