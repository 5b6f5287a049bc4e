#pragma once

#include <filesystem>
#include <stdexcept>

namespace baraka::run::output {

/// Another process has locked the folder; what() names the folder.
struct FolderHeld : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A lock on a folder, held until destruction or until this process dies. The lock is a file beside
/// the folder, so the folder may be renamed or may not exist.
class FolderLock {
 public:
  /// @pre The parent folder exists.
  /// @throws FolderHeld
  /// @throws std::runtime_error  the lock file belongs to another user, is not a file, or cannot be
  ///   written.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Whether some process has locked the folder, which need not exist.
bool is_held(const std::filesystem::path& folder);

/// Removes the lock file of a process that died. Does nothing if there is no such file, or if a
/// process holds the lock.
void remove_lock_of_the_dead(const std::filesystem::path& folder);

}  // namespace baraka::run::output
