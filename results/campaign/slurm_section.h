#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "hal/files/description/fields.h"
#include "hal/types/time.h"

namespace results::campaign {

/// How the runs of a campaign are submitted: the key `slurm` of its file.
struct SlurmSettings {
  std::string partition;                         ///< Empty: the cluster's default.
  std::optional<hal::Duration> time;             ///< Time limit of each run; none: the partition's.
  std::vector<std::string> arguments;            ///< Further arguments of `sbatch`.
  hal::Duration poll = std::chrono::seconds{5};  ///< Interval between two queries of the queue.
  /// Longest time from the end of a job to its result being visible on this computer.
  hal::Duration settle = std::chrono::seconds{60};
};

/// Describes the key `slurm` of a campaign file.
void slurm_key(hal::files::description::Fields& campaign, SlurmSettings& c);

/// Why an argument of `sbatch` is not allowed: the engine sets it itself. Empty: it is allowed.
std::string refusal(const std::string& argument);

}  // namespace results::campaign
