#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gateway/slurm/settings.h"

namespace gateway::slurm {

/// One call of a program.
struct Task {
  int index = 0;  ///< Below MaxArraySize of the cluster.
  std::vector<std::string> arguments;
};

/// Calls of one program, to be submitted in one command.
struct ArrayJob {
  std::string name;               ///< By which it is found again.
  std::filesystem::path program;  ///< The same path on every node.
  std::filesystem::path folder;   ///< Where the programs start; shared with the nodes.
  std::filesystem::path logs;     ///< Folder of what they print, shared with the nodes.
  std::vector<Task> tasks{};      ///< By rising index.
  std::optional<int> at_once{};   ///< Most that run at a time; none: as many as there is room for.
};

/// "0-3,7,9-10%2": what `sbatch --array` takes.
std::string indices_of(const ArrayJob& job);

/// What each task runs: bash, which becomes the program, so that a signal reaches that. A task that
/// starts again after its node was lost runs the same.
std::string script_of(const ArrayJob& job);

/// What the task of an index prints. Of all its starts: the last ones are at the end.
std::filesystem::path log_of(const ArrayJob& job, int index);
std::filesystem::path log_of(const std::filesystem::path& logs, const std::string& name, int index);

/// The command that submits the script and prints the number of the job.
std::vector<std::string> submission_of(const ArrayJob& job, const Settings& settings,
                                       const std::filesystem::path& script);

}  // namespace gateway::slurm
