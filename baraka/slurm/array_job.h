#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/campaign/slurm_section.h"

namespace baraka::slurm {

/// One call of a program.
struct Task {
  int index = 0;  ///< Below MaxArraySize of the cluster.
  std::vector<std::string> arguments;
  std::filesystem::path log{};  ///< What it prints is appended here.
};

/// Calls of one program, to be submitted in one command.
struct ArrayJob {
  std::string name;               ///< By which it is found again.
  std::filesystem::path program;  ///< The same path on every node.
  std::filesystem::path folder;   ///< Where the programs start; shared with the nodes.
  std::filesystem::path log;      ///< What Slurm has to say of the tasks is appended here.
  std::vector<Task> tasks{};      ///< By rising index.
  std::optional<int> at_once{};   ///< Most that run at a time; none: as many as there is room for.
};

/// "0-3,7,9-10%2": what `sbatch --array` takes.
std::string indices_of(const ArrayJob& job);

/// What each task runs: bash, which becomes the program, so that a signal reaches that. A task that
/// starts again after its node was lost runs the same.
std::string script_of(const ArrayJob& job);

/// The command that submits the script and prints the number of the job.
std::vector<std::string> submission_of(const ArrayJob& job,
                                       const results::campaign::SlurmSettings& settings,
                                       const std::filesystem::path& script);

}  // namespace baraka::slurm
