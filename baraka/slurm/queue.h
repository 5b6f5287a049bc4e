#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/result.h"

namespace baraka::slurm {

/// A task that waits, runs, or is about to end.
struct QueuedTask {
  std::string name;      ///< Name of its job.
  std::int64_t job = 0;  ///< Number of the array job.
  int index = 0;
  std::string state;   ///< "PENDING", "RUNNING", …
  std::string reason;  ///< Why it waits: "Resources", "JobHeldUser", …; "None".

  bool is_waiting() const { return state == "PENDING"; }
};

/// How a task ended, as far as Slurm still has a record of it.
struct JobEnd {
  std::string state;   ///< "COMPLETED", "FAILED", "TIMEOUT", "CANCELLED", "NODE_FAIL", …
  std::string reason;  ///< "NonZeroExitCode", …
  int status = 0;      ///< Exit status.
  int signal = 0;      ///< Signal that killed it; 0: none.
  std::string node;
  int restarts = 0;              ///< Number of times that it was started again.
  std::optional<double> wall_s;  ///< Wall time since its last start; none: not known.

  /// Whether the program ended by itself with this status.
  bool has_status(int value) const;
  std::string in_words() const;  ///< "TIMEOUT on n1 (TimeLimit)".
};

/// Format of squeue's output for each task, which parse_queue() reads.
inline constexpr const char* kQueueFormat = "%F|%K|%T|%j|%r";

/// Parses the output of squeue. Errors: kProtocol, naming the malformed line.
hal::Result<std::vector<QueuedTask>> parse_queue(std::string_view printed);

/// Parses the output of `scontrol --oneliner show job`; none: it contains no state.
std::optional<JobEnd> parse_job(std::string_view printed);

/// The value of a key in the output of `scontrol show config`.
std::optional<std::string> parse_config(std::string_view printed, std::string_view key);

/// The sum of allocated and idle processors in the output of `sinfo --format=%C`, which has lines
/// "allocated/idle/other/total".
std::optional<int> parse_processors(std::string_view printed);

/// The job's number in the output of `sbatch --parsable`: "12" or "12;cluster", maybe after other
/// lines.
std::optional<std::int64_t> parse_submission(std::string_view printed);

}  // namespace baraka::slurm
