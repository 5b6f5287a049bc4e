#include "baraka/run/output/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace baraka::run::output {
namespace {

namespace fs = std::filesystem;

fs::path lock_of(const fs::path& folder) {
  return folder.parent_path() / ("." + folder.filename().string() + ".lock");
}

std::string content(int descriptor) {
  std::string text(32, '\0');
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

/// Opens a lock file. Because it will be written to, links and files of other users are refused.
int open_lock(const fs::path& file, const fs::path& folder) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    if (errno == ELOOP) {
      throw std::runtime_error(file.string() + ": is a link, so it is not used as a lock");
    }
    throw std::runtime_error(fmt::format("{}: no results can be written in {}: {}", folder.string(),
                                         folder.parent_path().string(), std::strerror(errno)));
  }
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) || status.st_nlink > 1 ||
      status.st_uid != ::geteuid()) {
    ::close(descriptor);
    throw std::runtime_error(
        fmt::format("{}: is not a lock of this user; remove it", file.string()));
  }
  return descriptor;
}

/// Whether the open file still has that name: its last holder may have removed it.
bool is_still(const fs::path& file, int descriptor) {
  struct stat named {
  }, opened{};
  return ::lstat(file.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 &&
         named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : file_(lock_of(folder)) {
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = open_lock(file_, folder);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) continue;
    const std::string holder = content(descriptor_);
    ::close(descriptor_);
    throw FolderHeld(
        fmt::format("{}: another run is writing there (pid {})", folder.string(), holder));
  } while (!is_still(file_, descriptor_));
  const std::string pid = std::to_string(::getpid());
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, pid.data(), pid.size(), 0) < 0) {
    const int error = errno;
    ::unlink(file_.c_str());
    ::close(descriptor_);
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), std::strerror(error)));
  }
}

FolderLock::~FolderLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

void remove_lock_of_the_dead(const fs::path& folder) {
  if (!fs::exists(lock_of(folder)) || is_held(folder)) return;
  try {
    const FolderLock lock(folder);
  } catch (const std::runtime_error&) {
    return;  // another process was faster
  }
}

bool is_held(const fs::path& folder) {
  const int descriptor = ::open(lock_of(folder).c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return held;
}

}  // namespace baraka::run::output
