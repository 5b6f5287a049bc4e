#include "agentd/emergency_latch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "gateway/process/exit_status.h"
#include "hal/types/log.h"

namespace agentd {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWhatToDo =
    "an emergency stop would be forgotten when the daemon restarts; name a folder with --state, or "
    "do without by --no-state";

/// Empty: the variable names no absolute folder. Call it before there are threads.
fs::path folder_in(const char* variable) {
  const char* const value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
  std::string_view text = value == nullptr ? "" : value;
  text = text.substr(0, text.find(':'));  // systemd names all folders of a unit
  const fs::path folder(text);
  return folder.is_absolute() ? folder : fs::path{};
}

std::error_code last_error() { return {errno, std::generic_category()}; }

/// Writes a file or folder to the disk: what the file system only has in memory is lost when the
/// battery is.
std::error_code sync(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0644);
  if (descriptor < 0) return last_error();
  const std::error_code error = ::fsync(descriptor) == 0 ? std::error_code{} : last_error();
  ::close(descriptor);
  return error;
}

std::error_code make_file(const fs::path& file) {
  return sync(file, O_WRONLY | O_CREAT | O_NOFOLLOW);
}

}  // namespace

fs::path default_state_folder() {
  if (fs::path folder = folder_in("STATE_DIRECTORY"); !folder.empty()) return folder;
  if (const fs::path state = folder_in("XDG_STATE_HOME"); !state.empty()) return state / "baraka";
  if (const fs::path home = folder_in("HOME"); !home.empty()) {
    return home / ".local" / "state" / "baraka";
  }
  throw gateway::process::UsageError(
      fmt::format("no folder for state: neither STATE_DIRECTORY nor XDG_STATE_HOME nor HOME names "
                  "one; {}",
                  kWhatToDo));
}

EmergencyLatch::EmergencyLatch(const std::string& agent, const fs::path& folder)
    : file_(folder / (agent + ".emergency_stop")) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path probe = folder / fmt::format(".{}.{}", agent, ::getpid());
  if (!error) error = make_file(probe);
  std::error_code ignored;
  fs::remove(probe, ignored);
  if (!error) return;
  throw gateway::process::UsageError(
      fmt::format("{}: {}: {}", folder.string(), error.message(), kWhatToDo));
}

bool EmergencyLatch::is_set() const {
  if (file_.empty()) return false;
  // The entry counts, even if it is a broken link or cannot be inspected.
  std::error_code error;
  return fs::symlink_status(file_, error).type() != fs::file_type::not_found;
}

void EmergencyLatch::set(bool stopped) const {
  if (file_.empty()) return;
  std::error_code error;
  if (stopped) {
    if (!is_set()) error = make_file(file_);
  } else {
    fs::remove(file_, error);
  }
  if (!error) error = sync(file_.parent_path(), O_RDONLY | O_DIRECTORY);
  if (error) {
    hal::log::warning({}, "emergency stop", "{}: {}", file_.string(), error.message());
  }
}

}  // namespace agentd
