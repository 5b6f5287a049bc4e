#include "hal/config/shared_folders.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "hal/config/errors.h"

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

std::string listed_shared_folders() {
  std::string list;
  for (const fs::path& folder : shared_folders()) {
    list += (list.empty() ? "" : ", ") + folder.string();
  }
  return list;
}

namespace {

/// In the shared folders, or in one of their folders `kinds`.
std::optional<fs::path> find_of_kinds(const fs::path& file, const std::vector<std::string>& kinds) {
  if (auto found = find_shared(file)) return found;
  for (const std::string& kind : kinds) {
    if (auto found = find_shared(fs::path(kind) / file)) return found;
  }
  return std::nullopt;
}

}  // namespace

fs::path named_file(const fs::path& given, const std::vector<std::string>& kinds) {
  std::error_code error;
  if (given.is_absolute() || given.empty() || fs::exists(given, error)) return given;
  if (const auto found = find_of_kinds(given, kinds)) return *found;
  if (!given.has_extension()) {
    fs::path file = fs::path(given).replace_extension(".yaml");
    if (fs::exists(file, error)) return file;
    if (const auto found = find_of_kinds(file, kinds)) return *found;
  }
  throw ConfigErrors(
      {fmt::format("{}: there is no such file here, nor in {} or its {}", given.string(),
                   listed_shared_folders(), fmt::join(kinds, ", "))});
}

}  // namespace hal::config
