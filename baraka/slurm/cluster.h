#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "baraka/slurm/queue.h"
#include "hal/types/result.h"

namespace baraka::slurm {

/// The cluster that Slurm's commands on this computer use. Its answers may take seconds. Errors of
/// every call: the command's message on standard error, or that it did not answer.
class Cluster {
 public:
  /// @param interrupted  called while a command runs; true: give up.
  explicit Cluster(std::function<bool()> interrupted) : interrupted_(std::move(interrupted)) {}

  /// @throws UsageError  a command of Slurm is missing, or no slurmctld answers.
  void require() const;

  /// The lowest index that an array must not have (MaxArraySize); 1001 if the cluster does not say.
  hal::Result<int> first_bad_index() const;

  /// Number of usable processors, whoever may be using them now.
  /// @param partition  empty: all.
  /// @return none: the cluster does not say.
  std::optional<int> processors(const std::string& partition) const;

  /// Tasks of this user's jobs with these names that wait, run or are about to end.
  hal::Result<std::vector<QueuedTask>> queue(const std::set<std::string>& names) const;

  /// Submits a job. @param command  from submission_of().
  /// @return the number of the job, or an error if the cluster is too full to accept it now or did
  ///   not answer; it may have accepted the job nevertheless.
  hal::Result<std::int64_t> submit(const std::vector<std::string>& command) const;

  /// How a task ended. None: Slurm does not know the task any more, or does not answer.
  std::optional<JobEnd> end_of(std::int64_t job, int index) const;

  /// @param jobs  "12", or "12_3" for one task.
  hal::Result<void> cancel(const std::vector<std::string>& jobs) const;

 private:
  hal::Result<std::string> answer(const std::vector<std::string>& command) const;

  std::function<bool()> interrupted_;
};

}  // namespace baraka::slurm
