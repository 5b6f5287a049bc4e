#pragma once

#include <cstdio>
#include <string>

namespace tests {

/// What a command of the shell writes to its standard output; empty if it cannot be started.
inline std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  char buffer[4096];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) {
    text.append(buffer, count);
  }
  pclose(pipe);
  return text;
}

}  // namespace tests
