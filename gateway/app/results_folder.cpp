#include "gateway/app/results_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gateway::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockFile = ".lock";

/// Whether a file is one that a run writes.
bool is_result(const fs::path& file) {
  const std::string name = file.filename().string();
  return name == kLockFile || name.starts_with("run.sqlite") || name == "scenario.resolved.yaml" ||
         file.extension() == ".log";
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("{}: cannot be made: {}", path_.string(), error.message()));
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    if (is_result(entry.path())) continue;
    throw std::runtime_error(fmt::format("{}: not replaced, because {} in it is no result of a run",
                                         path_.string(), entry.path().filename().string()));
  }
  lock();
  clear();
}

ResultsFolder::~ResultsFolder() {
  if (lock_ < 0) return;
  ::unlink((path_ / kLockFile).c_str());
  ::close(lock_);
}

void ResultsFolder::lock() {
  const std::string file = (path_ / kLockFile).string();
  lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) throw std::runtime_error(fmt::format("{}: cannot be written", path_.string()));
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    std::string holder(32, '\0');
    const ssize_t size = ::pread(lock_, holder.data(), holder.size(), 0);
    holder.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    ::close(std::exchange(lock_, -1));
    throw std::runtime_error(
        fmt::format("{}: another run is writing there (pid {})", path_.string(), holder));
  }
  const std::string pid = std::to_string(::getpid());
  if (::ftruncate(lock_, 0) != 0 || ::pwrite(lock_, pid.data(), pid.size(), 0) < 0) {
    throw std::runtime_error(fmt::format("{}: cannot be written", file));
  }
}

void ResultsFolder::clear() {
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    if (entry.path().filename() != kLockFile) old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file);
}

}  // namespace gateway::app
