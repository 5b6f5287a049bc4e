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
  std::string name;      ///< Of its job.
  std::int64_t job = 0;  ///< Number of the array job.
  int index = 0;
  std::string state;   ///< "PENDING", "RUNNING", …
  std::string reason;  ///< Why it waits: "Resources", "JobHeldUser", …; "None".

  bool is_waiting() const { return state == "PENDING"; }
};

/// How a task ended, as far as Slurm still knows.
struct JobEnd {
  std::string state;   ///< "COMPLETED", "FAILED", "TIMEOUT", "CANCELLED", "NODE_FAIL", …
  std::string reason;  ///< "NonZeroExitCode", …
  int status = 0;      ///< Exit status.
  int signal = 0;      ///< That killed it.
  std::string node;
  int restarts = 0;              ///< How often it was started again.
  std::optional<double> wall_s;  ///< Of its last start.

  /// Whether the program ended by itself with this status.
  bool has_status(int value) const;
  std::string in_words() const;  ///< "TIMEOUT on n1 (TimeLimit)".
};

/// What squeue is asked to print for each task; parse_queue() reads it.
inline constexpr const char* kQueueFormat = "%F|%K|%T|%j|%r";

/// Errors: kProtocol, naming the line that is not as asked for.
hal::Result<std::vector<QueuedTask>> parse_queue(std::string_view printed);

/// Of `scontrol --oneliner show job`; none: it says nothing of a state.
std::optional<JobEnd> parse_job(std::string_view printed);

/// The value of a key that `scontrol show config` prints.
std::optional<std::string> parse_config(std::string_view printed, std::string_view key);

/// The sum of "allocated/idle/other/total" without the other ones, which `sinfo --format=%C` prints
/// in a line.
std::optional<int> parse_processors(std::string_view printed);

/// The number of the job that `sbatch --parsable` prints, "12" or "12;cluster", maybe after other
/// lines.
std::optional<std::int64_t> parse_submission(std::string_view printed);

}  // namespace baraka::slurm
