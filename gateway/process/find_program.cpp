#include "gateway/process/find_program.h"

#include <unistd.h>

namespace gateway::process {

std::optional<std::filesystem::path> find_program(
    const std::string& name, const std::vector<std::filesystem::path>& folders) {
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path candidate = folder / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(candidate, error)) continue;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

}  // namespace gateway::process
