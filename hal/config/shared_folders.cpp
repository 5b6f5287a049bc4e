#include "hal/config/shared_folders.h"

#include <cstdlib>
#include <sstream>
#include <string>

namespace hal::config {

namespace fs = std::filesystem;

std::vector<fs::path> shared_folders() {
  std::vector<fs::path> folders;
  const char* const variable = std::getenv("BARAKA_CONFIG_PATH");
  std::istringstream list(variable == nullptr ? "" : variable);
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  std::error_code unreadable;
  const fs::path self = fs::read_symlink("/proc/self/exe", unreadable);
  if (!unreadable) folders.push_back(self.parent_path().parent_path() / "share/baraka");
  return folders;
}

std::optional<fs::path> find_shared(const fs::path& relative) {
  for (const fs::path& folder : shared_folders()) {
    std::error_code error;
    if (fs::exists(folder / relative, error)) return folder / relative;
  }
  return std::nullopt;
}

}  // namespace hal::config
