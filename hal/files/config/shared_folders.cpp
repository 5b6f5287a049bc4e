#include "hal/files/config/shared_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

#include "hal/files/config/errors.h"
#include "hal/files/config/suggest.h"

namespace hal::files::config {

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

/// Names of the files in a folder, sorted; empty if it cannot be read.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error)) {
    std::error_code unknown;
    if (at->is_regular_file(unknown)) names.push_back(at->path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

/// "; did you mean 'walk.yaml'?", comparing names without their extensions.
std::string similar_in(const fs::path& folder, const fs::path& file) {
  const std::vector<std::string> files = files_in(folder);
  std::vector<std::string> stems;
  stems.reserve(files.size());
  for (const std::string& name : files) stems.push_back(fs::path(name).stem().string());
  const auto best = nearest(file.stem().string(), stems);
  return best ? fmt::format("; did you mean '{}'?", files[*best]) : "";
}

/// "; did you mean 'robots/mote.yaml'?" for a file with exactly this name, with or without its
/// extension, in a subfolder of a shared folder.
std::string same_name_below_shared(const fs::path& file) {
  const std::string name = file.stem().string() + ".yaml";
  for (const fs::path& shared : shared_folders()) {
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator at(shared, error), end; !error && at != end; at.increment(error)) {
      std::error_code unknown;
      if (fs::is_regular_file(at->path() / name, unknown)) {
        found.push_back((at->path().filename() / name).string());
      }
    }
    std::ranges::sort(found);
    if (!found.empty()) return fmt::format("; did you mean '{}'?", fmt::join(found, "' or '"));
  }
  return "";
}

/// Searches the shared folders and their subfolders `kinds`.
std::optional<fs::path> find_of_kinds(const fs::path& file, const std::vector<std::string>& kinds) {
  if (auto found = find_shared(file)) return found;
  for (const std::string& kind : kinds) {
    if (auto found = find_shared(fs::path(kind) / file)) return found;
  }
  return std::nullopt;
}

}  // namespace

std::string similar_file(const fs::path& file, const fs::path& relative) {
  std::string said = similar_in(file.parent_path(), file);
  if (relative.empty() || relative.is_absolute()) return said;
  if (said.empty()) said = same_name_below_shared(file);
  for (const fs::path& folder : shared_folders()) {
    if (said.empty()) said = similar_in(folder / relative.parent_path(), file);
  }
  return said;
}

namespace {

/// Suggests a file from the places that find_of_kinds() searches.
std::string similar_of_kinds(const fs::path& given, const std::vector<std::string>& kinds) {
  std::string said = similar_file(given, given);
  for (const std::string& kind : kinds) {
    if (said.empty()) said = similar_file(given, fs::path(kind) / given);
  }
  return said;
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
  throw ConfigErrors({fmt::format("{}: there is no such file here, nor in {} or its {}{}",
                                  given.string(), listed_shared_folders(), fmt::join(kinds, ", "),
                                  similar_of_kinds(given, kinds))});
}

}  // namespace hal::files::config
