#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/types/time.h"

namespace gateway::slurm {

/// How the runs of a campaign are submitted: the key `slurm` of its file.
struct Settings {
  std::string partition;                         ///< Empty: the cluster's default.
  std::optional<hal::Duration> time;             ///< Limit of each run; none: the partition's.
  std::vector<std::string> arguments;            ///< Further ones of `sbatch`.
  hal::Duration poll = std::chrono::seconds{5};  ///< Between two looks at the queue.
  /// Until a result that Slurm says is there must be seen here.
  hal::Duration settle = std::chrono::seconds{60};
};

/// Reads the key `slurm` of a campaign file; absent: as above.
Settings read_settings(hal::config::Mapping& campaign);

/// As `sbatch --time` takes it, whole seconds and not less: "1-02:03:04".
std::string time_limit(hal::Duration limit);

/// Why an argument of `sbatch` cannot be given: the engine needs it itself; empty: it can.
std::string refusal(const std::string& argument);

}  // namespace gateway::slurm
