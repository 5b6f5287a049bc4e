#include "options.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char kUsage[] =
    "usage: %s [--publish TOPIC] [--subscribe TOPIC] [OPTION...]\n"
    "  --domain N          default 0\n"
    "  --writer N          told in every sample; default 0\n"
    "  --size B            bytes of a sample's sequence; default 64\n"
    "  --rate HZ           default 10\n"
    "  --count N           samples; default: until the end\n"
    "  --reliable | --best-effort\n"
    "  --keep-last N | --keep-all\n"
    "  --blocking S        that a reliable write may wait for room\n"
    "  --until-matched N   wait for N remote readers and writers before the first sample\n"
    "  --patience S        but no longer than that; default: to the end\n"
    "  --settle S          after that, before the first sample; default 0.2\n"
    "  --phase S           writes when the monotonic clock is that far beyond a multiple of the "
    "period\n"
    "  --linger S          ends that long after its last sample\n"
    "  --for S             ends after that at the latest, default 10\n"
    "  --csv FILE          every write, sample and match\n";

static void refuse(const char* program, const char* option, const char* value) {
  if (value != NULL)
    fprintf(stderr, "%s: %s: '%s' is not allowed\n", program, option, value);
  else
    fprintf(stderr, "%s: %s: is not known, or lacks its value\n", program, option);
  fprintf(stderr, kUsage, program);
  exit(2);
}

static double number(char** argv, const char* option, const char* text, double least, double most) {
  char* end = NULL;
  errno = 0;
  const double value = strtod(text, &end);
  if (end == text || *end != '\0' || errno != 0 || !(value >= least && value <= most))
    refuse(argv[0], option, text);
  return value;
}

static uint64_t whole(char** argv, const char* option, const char* text, double least,
                      double most) {
  const double value = number(argv, option, text, least, most);
  if (value != floor(value)) refuse(argv[0], option, text);
  return (uint64_t)value;
}

/* @return whether it is one of the options without a value. */
static bool read_flag(const char* option, Options* into) {
  if (strcmp(option, "--reliable") == 0)
    into->reliability = kReliable;
  else if (strcmp(option, "--best-effort") == 0)
    into->reliability = kBestEffort;
  else if (strcmp(option, "--keep-all") == 0)
    into->keep_all = true;
  else
    return false;
  return true;
}

static void read_value(char** argv, const char* option, const char* text, Options* into) {
  const double most = 4294967295.0;
  if (strcmp(option, "--publish") == 0)
    into->publish = text;
  else if (strcmp(option, "--subscribe") == 0)
    into->subscribe = text;
  else if (strcmp(option, "--csv") == 0)
    into->csv = text;
  else if (strcmp(option, "--domain") == 0)
    into->domain = (uint32_t)whole(argv, option, text, 0, 232);
  else if (strcmp(option, "--writer") == 0)
    into->writer = (uint32_t)whole(argv, option, text, 0, most);
  else if (strcmp(option, "--size") == 0)
    into->size = (uint32_t)whole(argv, option, text, 0, 1e9);
  else if (strcmp(option, "--rate") == 0)
    into->rate = number(argv, option, text, 1e-3, 1e6);
  else if (strcmp(option, "--count") == 0)
    into->count = whole(argv, option, text, 1, 1e15);
  else if (strcmp(option, "--keep-last") == 0)
    into->keep_last = (uint32_t)whole(argv, option, text, 1, 1e6);
  else if (strcmp(option, "--blocking") == 0)
    into->blocking = number(argv, option, text, 1e-6, 1e6);
  else if (strcmp(option, "--until-matched") == 0)
    into->until_matched = (uint32_t)whole(argv, option, text, 1, 1e6);
  else if (strcmp(option, "--patience") == 0)
    into->patience = number(argv, option, text, 0, 1e6);
  else if (strcmp(option, "--settle") == 0)
    into->settle = number(argv, option, text, 0, 1e6);
  else if (strcmp(option, "--phase") == 0)
    into->phase = number(argv, option, text, 0, 1e6);
  else if (strcmp(option, "--linger") == 0)
    into->linger = number(argv, option, text, 0, 1e6);
  else if (strcmp(option, "--for") == 0)
    into->seconds = number(argv, option, text, 1e-3, 1e6);
  else
    refuse(argv[0], option, NULL);
}

Options read_options(int argc, char** argv) {
  Options options = {.size = 64,
                     .rate = 10,
                     .patience = 1e6,
                     .settle = 0.2,
                     .phase = -1,
                     .linger = -1,
                     .seconds = 10};
  for (int i = 1; i < argc; ++i) {
    if (read_flag(argv[i], &options)) continue;
    if (i + 1 == argc) refuse(argv[0], argv[i], NULL);
    read_value(argv, argv[i], argv[i + 1], &options);
    ++i;
  }
  if (options.publish == NULL && options.subscribe == NULL)
    refuse(argv[0], "--publish or --subscribe", NULL);
  if (options.keep_all && options.keep_last > 0) refuse(argv[0], "--keep-all", "with --keep-last");
  return options;
}
