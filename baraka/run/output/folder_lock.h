#pragma once

#include <filesystem>
#include <stdexcept>

namespace baraka::run::output {

/// Another process holds the folder; what() names it.
struct FolderHeld : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A folder that this process holds until destruction, or until it dies. The lock is a file beside
/// the folder, so the folder may be renamed or not be there at all.
class FolderLock {
 public:
  /// @pre the folder that it is in exists. @throws FolderHeld. @throws std::runtime_error  the lock
  ///   is no file of this user's, or cannot be written.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Whether some process holds the folder, which need not exist.
bool is_held(const std::filesystem::path& folder);

/// Removes the file that a process left which died while it held the folder. Does nothing if there
/// is none, or if a process holds it.
void remove_lock_of_the_dead(const std::filesystem::path& folder);

}  // namespace baraka::run::output
