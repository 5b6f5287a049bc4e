#include "gateway/search_path.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace gateway {

std::vector<std::filesystem::path> controller_folders() {
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  const auto executable = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(executable.parent_path());
  const char* path = std::getenv("BARAKA_CONTROLLER_PATH");
  std::istringstream parts(path == nullptr ? "" : path);
  for (std::string part; std::getline(parts, part, ':');) {
    if (!part.empty()) folders.emplace_back(part);
  }
  return folders;
}

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

}  // namespace gateway
