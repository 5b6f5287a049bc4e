#include "gateway/runtime/python_file.h"

#include <dlfcn.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <mutex>

#include "gateway/runtime/plugin.h"

namespace gateway::runtime {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibrary = "libbaraka_python.so";

/// baraka_python_controller() of python/host.
using Ask = const hal::ControllerKind* (*)(const char*, const char*, std::string&);

hal::Result<Ask> python_library() {
  for (const fs::path& folder : controller_folders()) {
    const fs::path file = folder / kLibrary;
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) continue;
    void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const ask = library == nullptr ? nullptr : ::dlsym(library, "baraka_python_controller");
    if (ask == nullptr) {
      return hal::fail(hal::Errc::kProtocol,
                       fmt::format("{} cannot be loaded: {}", file.string(), ::dlerror()));
    }
    return reinterpret_cast<Ask>(ask);
  }
  return hal::fail(hal::Errc::kNotAvailable,
                   fmt::format("controllers in Python need {}, of the package python3-baraka, "
                               "which is not there",
                               kLibrary));
}

}  // namespace

std::string python_interpreter() {
  const char* const named = std::getenv("BARAKA_PYTHON");
  return named == nullptr || *named == '\0' ? "/usr/bin/python3" : named;
}

bool is_python(std::string_view program) { return program.ends_with(".py"); }

hal::Result<const hal::ControllerKind*> load_python(const fs::path& file) {
  // A file is run once: its classes, and what it has in memory, stay. Environments load on several
  // threads.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  static std::map<fs::path, const hal::ControllerKind*> known;
  if (const auto found = known.find(file); found != known.end()) return found->second;
  const auto ask = python_library();
  if (!ask) return tl::unexpected(ask.error());
  const std::string interpreter = python_interpreter();
  if (::access(interpreter.c_str(), X_OK) != 0) {  // in this process Python would begin as another
    return hal::fail(hal::Errc::kInvalidArgument,
                     fmt::format("BARAKA_PYTHON: '{}' is not the path of a program", interpreter));
  }
  std::string mistake;
  const hal::ControllerKind* const kind = (*ask)(file.c_str(), interpreter.c_str(), mistake);
  if (kind == nullptr) return hal::fail(hal::Errc::kInvalidArgument, std::move(mistake));
  if (kind->build_id != BARAKA_HAL_DIGEST) {
    return hal::fail(hal::Errc::kProtocol,
                     "the package python3-baraka was built with other headers of the HAL");
  }
  known[file] = kind;
  return kind;
}

}  // namespace gateway::runtime
