#pragma once

#include <filesystem>

namespace gateway::app {

/// A folder that this process holds until destruction, or until it dies.
class FolderLock {
 public:
  static constexpr const char* kFile = ".lock";  ///< In the folder; names the holder.

  /// @pre the folder exists. @throws std::runtime_error  if another process holds it, naming that
  ///   one, or it cannot be written.
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

}  // namespace gateway::app
