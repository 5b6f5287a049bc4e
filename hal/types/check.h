#pragma once

#include <cstdio>
#include <cstdlib>

/// Stops the program when an invariant of ours is broken. Always on, also in release builds:
/// a simulation that is wrong must not go on producing numbers.
#define BARAKA_CHECK(condition)                                                          \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      std::fprintf(stderr, "%s:%d: check failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                      \
    }                                                                                    \
  } while (false)
