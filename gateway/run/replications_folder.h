#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "gateway/run/folder_lock.h"

namespace gateway {

/// One run of many: the scenario with another seed.
struct Replication {
  int number = 1;  ///< From 1.
  std::uint64_t seed = 0;
  std::string name() const;  ///< "replication-01": its folder, and before ".log" what it printed.
};

/// How a replication ended.
struct ReplicationEnd {
  int status = 0;      ///< As of the program.
  std::string result;  ///< As the scenario calls it.
  std::string error;   ///< If it failed.
};

/// The folder of many runs of one scenario, held by this process until destruction. What is in it
/// belongs to one scenario, `--until` and version: `replications.yaml` tells which.
class ReplicationsFolder {
 public:
  struct Settings {
    std::string scenario;         ///< Resolved.
    std::optional<double> until;  ///< Simulated seconds.
    bool overwrite = false;       ///< Remove an earlier result of a single run there.
  };

  /// An earlier result of a single run in the folder is kept beside it, as ResultsFolder does.
  /// @throws hal::config::ConfigErrors  if it holds replications of another scenario.
  /// @throws UsageError  it holds what no run wrote.
  /// @throws std::runtime_error  if another run holds it, or it cannot be written.
  ReplicationsFolder(const std::filesystem::path& path, const Settings& settings);

  const std::filesystem::path& path() const { return path_; }

  /// The scenario as it was when the first of them started: what all of them run.
  std::filesystem::path scenario() const;

  /// How a replication ended by its own account; none if it has not begun, or was cut short.
  std::optional<ReplicationEnd> end_of(const Replication& replication) const;

  /// The last words of a replication that left no account: its error, or the last line of its log.
  std::string last_words(const Replication& replication) const;

 private:
  void claim(const std::string& identity);
  std::optional<std::filesystem::path> make(bool overwrite);

  std::filesystem::path path_;
  std::optional<FolderLock> lock_;
};

}  // namespace gateway
