#include "baraka/run/output/results_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "baraka/run/output/result_marker.h"
#include "gateway/process/exit_status.h"

namespace baraka::run::output {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNotStarted = ".not-started";
constexpr const char* kReplaced = ".replaced";

fs::path beside(const fs::path& folder, const std::string& suffix) {
  return folder.parent_path() / (folder.filename().string() + suffix);
}

bool is_there(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

void rename_folder(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) == 0) return;
  throw std::runtime_error(fmt::format("{}: cannot be renamed to {}: {}", from.string(),
                                       to.string(), std::strerror(errno)));
}

/// One more than the highest number of the folders beside it, so that they stay sorted by age.
fs::path next_kept(const fs::path& folder) {
  const std::string prefix = folder.filename().string() + ".";
  int highest = 0;
  const fs::path parent = folder.parent_path();
  for (const fs::directory_entry& entry : fs::directory_iterator(parent.empty() ? "." : parent)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    int number = 0;
    const auto [end, error] =
        std::from_chars(name.data() + prefix.size(), name.data() + name.size(), number);
    if (error == std::errc() && end == name.data() + name.size())
      highest = std::max(highest, number);
  }
  return beside(folder, fmt::format(".{}", highest + 1));
}

/// The permissions of a folder, for the folder that will replace it; none: there is no such folder.
std::optional<mode_t> rights_of(const fs::path& folder) {
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) return std::nullopt;
  return status.st_mode & 07777U;
}

bool is_mount_point(const fs::path& folder) {
  struct stat inner {
  }, outer{};
  return ::stat(folder.c_str(), &inner) == 0 && ::stat((folder / "..").c_str(), &outer) == 0 &&
         inner.st_dev != outer.st_dev;
}

void make_new_folder(const fs::path& folder, std::optional<mode_t> rights) {
  if (::mkdir(folder.c_str(), 0777) != 0) {
    throw std::runtime_error(
        fmt::format("{}: cannot be made: {}", folder.string(), std::strerror(errno)));
  }
  if (rights) ::chmod(folder.c_str(), *rights);
}

}  // namespace

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    throw std::runtime_error(fmt::format("{}: cannot be made: {}", path.string(), error.message()));
  }
}

fs::path folder_named(const fs::path& path) {
  fs::path folder = path.lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // a slash at the end
  const std::string name = folder.filename().string();
  const fs::file_status status = fs::symlink_status(folder);
  if (name.empty() || name == "." || name == ".." || fs::is_symlink(status)) {
    folder = fs::weakly_canonical(folder);
  }
  if (is_there(folder) && !fs::is_directory(fs::symlink_status(folder))) {
    throw gateway::process::UsageError(fmt::format("{}: is there and no folder", folder.string()));
  }
  if (is_mount_point(folder)) {
    throw gateway::process::UsageError(
        fmt::format("{}: cannot be renamed, because a file system is mounted there; "
                    "give a folder in it",
                    folder.string()));
  }
  return folder;
}

void require_result_or_nothing(const fs::path& folder) {
  if (!is_there(folder)) return;
  if (!fs::is_directory(fs::symlink_status(folder))) {
    throw gateway::process::UsageError(fmt::format("{}: is there and no folder", folder.string()));
  }
  constexpr std::size_t kShown = 3;
  const std::vector<std::string> foreign = foreign_files(folder);
  if (foreign.empty()) return;
  if (std::ranges::find(foreign, kReplicationsFile) != foreign.end()) {
    throw gateway::process::UsageError(
        fmt::format("{}: holds replications ({}), which a single run does not replace; "
                    "give another --out",
                    folder.string(), kReplicationsFile));
  }
  std::string names;
  for (std::size_t i = 0; i < std::min(kShown, foreign.size()); ++i) {
    names += (i == 0 ? "" : ", ") + foreign[i];
  }
  if (foreign.size() > kShown) names += fmt::format(" and {} more", foreign.size() - kShown);
  throw gateway::process::UsageError(
      fmt::format("{}: contains files that no run wrote, so it is left as it is: {}; give another "
                  "--out, or move them away",
                  folder.string(), names));
}

std::optional<fs::path> set_aside(const fs::path& folder, bool overwrite) {
  if (!is_there(folder) || fs::is_empty(folder)) return std::nullopt;
  const fs::path place = overwrite ? beside(folder, kReplaced) : next_kept(folder);
  rename_folder(folder, place);
  return place;
}

void finish_set_aside(const fs::path& folder) {
  const fs::path replaced = beside(folder, kReplaced);
  if (!is_there(replaced)) return;
  require_result_or_nothing(replaced);
  if (read_marker(folder) || is_there(folder / kReplicationsFile)) {
    remove_result(replaced);
  } else if (!is_there(folder) || fs::is_empty(folder)) {
    rename_folder(replaced, folder);  // the run that was to replace it never began
  }
}

ResultsFolder::ResultsFolder(const fs::path& out, const Settings& settings,
                             std::unique_ptr<FolderLock> held)
    : out_(folder_named(out)),
      path_(beside(out_, kNotStarted)),
      overwrite_(settings.overwrite),
      run_id_(new_run_id()),
      lock_(std::move(held)) {
  if (out_.has_parent_path()) make_folder(out_.parent_path());
  if (!lock_) lock_ = std::make_unique<FolderLock>(out_);
  finish_set_aside(out_);
  require_result_or_nothing(out_);
  require_result_or_nothing(path_);
  remove_result(path_);
  make_new_folder(path_, rights_of(out_));
  write_marker(path_, {run_id_, settings.files});
}

void ResultsFolder::begin() {
  const std::optional<fs::path> old = set_aside(out_, overwrite_);
  try {
    rename_folder(path_, out_);
  } catch (const std::runtime_error&) {
    if (old && !is_there(out_)) rename_folder(*old, out_);
    throw;
  }
  path_ = out_;
  if (old && overwrite_) remove_result(*old);
  if (!overwrite_) kept_ = old;
}

}  // namespace baraka::run::output
