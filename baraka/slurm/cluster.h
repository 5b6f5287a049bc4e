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

/// The cluster that Slurm's commands on this computer lead to. Its answers may take seconds. Errors
/// of every call: what the command said on standard error, or that it did not answer.
class Cluster {
 public:
  /// @param interrupted  asked while a command runs: whether to give it up.
  explicit Cluster(std::function<bool()> interrupted) : interrupted_(std::move(interrupted)) {}

  /// @throws UsageError  a command of Slurm is missing, or no slurmctld answers.
  void require() const;

  /// The first index that no array may have; 1001 where the cluster does not say it.
  hal::Result<int> first_bad_index() const;

  /// That can be used, by whomever. @param partition  empty: all. None: the cluster does not say
  /// it.
  std::optional<int> processors(const std::string& partition) const;

  /// Tasks of this user's jobs of these names that wait, run or are about to end.
  hal::Result<std::vector<QueuedTask>> queue(const std::set<std::string>& names) const;

  /// @param command  of submission_of(). @return the number of the job. Given up when the cluster
  /// is
  ///   too full to take it now, or at an error; then it may have been taken all the same.
  hal::Result<std::int64_t> submit(const std::vector<std::string>& command) const;

  /// None: Slurm does not know the task any more, or does not answer.
  std::optional<JobEnd> end_of(std::int64_t job, int index) const;

  /// @param jobs  "12", or "12_3" for one task.
  hal::Result<void> cancel(const std::vector<std::string>& jobs) const;

 private:
  hal::Result<std::string> answer(const std::vector<std::string>& command) const;

  std::function<bool()> interrupted_;
};

}  // namespace baraka::slurm
