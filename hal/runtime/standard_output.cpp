#include "hal/runtime/standard_output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace hal::runtime {

int with_output_written(int status) {
  errno = 0;
  // Some of it may have failed before.
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (is_written) return status;
  const char* const why = errno == 0 ? "could not be written" : std::strerror(errno);
  std::fprintf(stderr, "error: standard output: %s\n", why);
  return status == 0 ? 1 : status;
}

}  // namespace hal::runtime
