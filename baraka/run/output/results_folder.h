#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "baraka/run/output/folder_lock.h"

namespace baraka::run::output {

/// The request of `--replications`: the file that a folder of many runs has instead of a marker.
inline constexpr const char* kReplicationsFile = "replications.yaml";

/// The folder of a run's results, locked by this process until destruction.
///
///   <out>.not-started   a run that has not begun yet; stays if the run never begins
///   <out>               the result of the run that began last
///   <out>.1, .2, …      earlier results, the oldest first, unless they are overwritten
///   <out>.replaced      a result that is being overwritten; removed when the new run has begun
///
/// Folders are renamed as a whole, so each is complete whenever this process dies. A folder that
/// contains anything that no run wrote is refused.
class ResultsFolder {
 public:
  struct Settings {
    std::vector<std::string> files;  ///< Every file that the run may write.
    bool overwrite = false;          ///< Remove an earlier result instead of keeping it.
  };

  /// Creates <out>.not-started.
  /// @param held  lock on <out>; null: this takes it.
  /// @throws UsageError  one of the folders is not a result, or holds something that no run wrote.
  /// @throws std::runtime_error  another run holds the lock, or the folder cannot be written.
  ResultsFolder(const std::filesystem::path& out, const Settings& settings,
                std::unique_ptr<FolderLock> held = nullptr);

  /// Marks the run as begun: sets an earlier result aside and renames the folder to <out>.
  /// @throws std::runtime_error  this failed; the earlier result is still in place.
  void begin();

  /// The current path of the folder.
  const std::filesystem::path& path() const { return path_; }
  const std::string& run_id() const { return run_id_; }

  /// Where begin() has moved an earlier result; none: there was none, or it was overwritten.
  const std::optional<std::filesystem::path>& kept() const { return kept_; }

 private:
  std::filesystem::path out_, path_;
  bool overwrite_;
  std::string run_id_;
  std::optional<std::filesystem::path> kept_;
  std::unique_ptr<FolderLock> lock_;
};

/// Creates a folder and its parents. @throws std::runtime_error
void make_folder(const std::filesystem::path& path);

/// The absolute folder that a path names, with links resolved and without dots. Need not exist.
/// @throws UsageError  the path exists and is not a folder, or the folder cannot be renamed.
std::filesystem::path folder_named(const std::filesystem::path& path);

/// Moves a result to the next free `<folder>.N`, or removes it to overwrite it.
/// @pre The folder holds a result and nothing else, or does not exist.
/// @return the new place of the result; none: there was none, or it was removed.
std::optional<std::filesystem::path> set_aside(const std::filesystem::path& folder, bool overwrite);

/// Completes a set_aside() that was killed. @pre This process holds the folder's lock.
void finish_set_aside(const std::filesystem::path& folder);

/// @throws UsageError  the folder holds something that no run wrote; the message names it.
void require_result_or_nothing(const std::filesystem::path& folder);

}  // namespace baraka::run::output
