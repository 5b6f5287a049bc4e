#include "gateway/runtime/plugin.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include "gateway/runtime/python_file.h"
#include "hal/files/config/suggest.h"

namespace gateway::runtime {
namespace {

namespace fs = std::filesystem;

std::string list_of(const std::vector<fs::path>& folders) {
  std::string list;
  for (const fs::path& folder : folders) list += (list.empty() ? "" : ", ") + folder.string();
  return list.empty() ? "nowhere" : list;
}

/// The reason dlopen or dlsym failed.
std::string loader_message() {
  const char* const message = ::dlerror();
  return message == nullptr ? "unknown reason" : message;
}

hal::Result<const hal::ControllerKind*> load(const fs::path& file) {
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return hal::fail(hal::Errc::kProtocol,
                     fmt::format("{} cannot be loaded: {}", file.string(), loader_message()));
  }
  void* const entry = ::dlsym(library, "baraka_controller");
  if (entry == nullptr) {
    return hal::fail(hal::Errc::kInvalidArgument,
                     fmt::format("{} is no controller: {}", file.string(), loader_message()));
  }
  const auto describe = reinterpret_cast<const hal::ControllerKind* (*)()>(entry);
  const hal::ControllerKind* const kind = describe();
  if (kind->build_id != BARAKA_HAL_DIGEST) {
    return hal::fail(
        hal::Errc::kProtocol,
        fmt::format("{} was built with other headers of the HAL; build it again", file.string()));
  }
  return kind;
}

}  // namespace

std::vector<fs::path> named_controller_folders() {
  std::vector<fs::path> folders;
  const char* const variable = std::getenv("BARAKA_CONTROLLER_PATH");
  std::istringstream list(variable == nullptr ? "" : variable);
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

std::vector<fs::path> controller_folders() {
  std::vector<fs::path> folders = named_controller_folders();
  std::error_code unreadable;
  const fs::path self = fs::read_symlink("/proc/self/exe", unreadable);
  if (!unreadable) {
    folders.push_back(self.parent_path());
    const fs::path installed = self.parent_path().parent_path() / "lib/baraka";
    if (fs::is_directory(installed, unreadable)) folders.push_back(installed);
  }
  return folders;
}

namespace {

/// "; /home/me/x.so is a link to a file that is not there", or empty.
std::string broken_link(const fs::path& file_name, const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (!fs::is_symlink(folder / file_name, ignored)) continue;
    return fmt::format("; {} is a link to a file that is not there", (folder / file_name).string());
  }
  return "";
}

/// "; did you mean 'wanderer'?", or empty.
std::string similar_plugin(std::string_view name, const std::vector<fs::path>& folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      std::error_code unknown;
      const bool is_there = at->is_regular_file(unknown);  // false for a broken link
      if (is_there && at->path().extension() == ".so") names.insert(at->path().stem().string());
      if (is_there && is_python(at->path().string())) names.insert(at->path().filename().string());
    }
  }
  return hal::files::config::suggestion(name, {names.begin(), names.end()});
}

}  // namespace

hal::Result<const hal::ControllerKind*> load_plugin(std::string_view name,
                                                    const std::vector<fs::path>& folders) {
  if (name.empty() || name.find('/') != std::string_view::npos) {
    return hal::fail(hal::Errc::kInvalidArgument,
                     fmt::format("'{}' is not the name of a controller", name));
  }
  const std::string file_name = is_python(name) ? std::string(name) : fmt::format("{}.so", name);
  for (const fs::path& folder : folders) {
    const fs::path file = fs::absolute(folder / file_name).lexically_normal();
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) return is_python(name) ? load_python(file) : load(file);
  }
  return hal::fail(hal::Errc::kNotAvailable,
                   fmt::format("'{}' is not a known controller: looked for {} in {}; "
                               "BARAKA_CONTROLLER_PATH adds folders{}{}",
                               name, file_name, list_of(folders), broken_link(file_name, folders),
                               similar_plugin(name, folders)));
}

}  // namespace gateway::runtime
