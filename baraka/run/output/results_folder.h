#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "baraka/run/output/folder_lock.h"

namespace baraka::run::output {

/// What a folder of many runs has instead of a marker: what was asked for.
inline constexpr const char* kReplicationsFile = "replications.yaml";

/// The folder a run writes its results to, held by this process until destruction.
///
///   <out>.not-started   what there is of a run until it has begun; stays if it never does
///   <out>               the result of the run that began last
///   <out>.1, .2, …      earlier ones, the oldest first, unless they are overwritten
///   <out>.replaced      one that is being overwritten; gone when the new one has begun
///
/// Folders are renamed as a whole, so each is complete at any instant, whenever this process dies.
/// A folder in which anything lies that no run wrote is refused.
class ResultsFolder {
 public:
  struct Settings {
    std::vector<std::string> files;  ///< Every file that the run may write.
    bool overwrite = false;          ///< Remove an earlier result instead of keeping it.
  };

  /// Makes the folder of what has not begun.
  /// @throws UsageError  one of the folders is not a result's or holds what no run wrote.
  /// @throws std::runtime_error  another run holds it, or it cannot be written.
  /// @param held  the lock of the folder; null: it is to be taken.
  ResultsFolder(const std::filesystem::path& out, const Settings& settings,
                std::unique_ptr<FolderLock> held = nullptr);

  /// The run has begun: its folder gets its name, and an earlier result makes room for it.
  /// @throws std::runtime_error  it cannot; then the earlier result is still there.
  void begin();

  /// Where it is now.
  const std::filesystem::path& path() const { return path_; }
  const std::string& run_id() const { return run_id_; }

  /// Where begin() has put an earlier result.
  const std::optional<std::filesystem::path>& kept() const { return kept_; }

 private:
  std::filesystem::path out_, path_;
  bool overwrite_;
  std::string run_id_;
  std::optional<std::filesystem::path> kept_;
  std::unique_ptr<FolderLock> lock_;
};

/// Makes a folder and those it is in. @throws std::runtime_error
void make_folder(const std::filesystem::path& path);

/// The folder that a path names in the end: links to folders resolved, no dots. Need not exist.
/// @throws UsageError  it is there and no folder, or cannot be renamed.
std::filesystem::path folder_named(const std::filesystem::path& path);

/// Moves a result to the next free `<folder>.N`, or removes it to overwrite it.
/// @pre the folder holds a result and nothing else, or is not there. @return where it is kept.
std::optional<std::filesystem::path> set_aside(const std::filesystem::path& folder, bool overwrite);

/// Ends what set_aside() was killed in. @pre the folder is held.
void finish_set_aside(const std::filesystem::path& folder);

/// @throws UsageError  the folder holds what no run wrote, and names it.
void require_result_or_nothing(const std::filesystem::path& folder);

}  // namespace baraka::run::output
