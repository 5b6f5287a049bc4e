#pragma once

#include <filesystem>
#include <optional>

#include "gateway/app/folder_lock.h"

namespace gateway::app {

/// The folder a run writes its results to, held by this process until destruction. An earlier
/// result in it is replaced; a folder with anything else in it is left alone.
class ResultsFolder {
 public:
  /// @throws std::runtime_error  if another run holds it, it has files that are no results, or it
  ///   cannot be written.
  explicit ResultsFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

 private:
  void clear();

  std::filesystem::path path_;
  std::optional<FolderLock> lock_;
};

/// Makes a folder and those it is in. @throws std::runtime_error
void make_folder(const std::filesystem::path& path);

}  // namespace gateway::app
