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
  std::optional<hal::Duration> time;             ///< Limit of each run; none: the partition's.
  std::vector<std::string> arguments;            ///< Further ones of `sbatch`.
  hal::Duration poll = std::chrono::seconds{5};  ///< Between two looks at the queue.
  /// Until a result that Slurm says is there must be seen here.
  hal::Duration settle = std::chrono::seconds{60};
};

/// The key `slurm` of a campaign file.
void slurm_key(hal::files::description::Fields& campaign, SlurmSettings& c);

/// Why an argument of `sbatch` cannot be given: the engine needs it itself; empty: it can.
std::string refusal(const std::string& argument);

}  // namespace results::campaign
