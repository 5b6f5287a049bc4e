#include "gateway/process/standard_output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "hal/types/terminal_colours.h"

namespace gateway::process {

int with_output_written(int status) {
  errno = 0;
  // An earlier write may have failed.
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (is_written) return status;
  const char* const why = errno == 0 ? "could not be written" : std::strerror(errno);
  hal::print_line(hal::Tone::kMistake, std::string("error: standard output: ") + why);
  return status == 0 ? 1 : status;
}

}  // namespace gateway::process
