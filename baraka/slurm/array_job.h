#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/campaign/slurm_section.h"

namespace baraka::slurm {

/// One task of an array job: a call of a program.
struct Task {
  int index = 0;  ///< Below MaxArraySize of the cluster.
  std::vector<std::string> arguments;
  std::filesystem::path log{};  ///< File to which its output is appended.
};

/// Calls of one program, submitted together.
struct ArrayJob {
  std::string name;               ///< Name of the job, by which it is found again.
  std::filesystem::path program;  ///< The same path on every node.
  std::filesystem::path folder;   ///< Working directory; shared with the nodes.
  std::filesystem::path log;      ///< File to which Slurm's messages about tasks are appended.
  std::vector<Task> tasks{};      ///< Sorted by index.
  std::optional<int> at_once{};   ///< Most parallel tasks; none: no limit.
};

/// The argument of `sbatch --array`: "0-3,7,9-10%2".
std::string indices_of(const ArrayJob& job);

/// The script that each task runs. Its shell is replaced by the program (exec), so that signals
/// reach the program. A task that starts again after its node was lost runs the same script.
std::string script_of(const ArrayJob& job);

/// The command that submits the script and prints the job's number.
std::vector<std::string> submission_of(const ArrayJob& job,
                                       const results::campaign::SlurmSettings& settings,
                                       const std::filesystem::path& script);

}  // namespace baraka::slurm
