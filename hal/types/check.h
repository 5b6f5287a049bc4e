#pragma once

#include <cstdio>
#include <cstdlib>

/// Aborts the program with file, line and condition if an internal invariant does not hold. Active
/// in release builds, too: a wrong simulation must not continue to produce numbers.
#define BARAKA_CHECK(condition)                                                          \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      std::fprintf(stderr, "%s:%d: check failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                      \
    }                                                                                    \
  } while (false)
