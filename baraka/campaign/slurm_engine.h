#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baraka/campaign/engine.h"
#include "baraka/slurm/cluster.h"
#include "baraka/slurm/submissions.h"
#include "results/campaign/slurm_section.h"

namespace baraka::campaign {

/// Runs tasks as Slurm array jobs on the nodes of a cluster. The campaign's folder must be on a
/// file system that this computer and the nodes share and on which file locks (FolderLock) work.
///
///   start()   ──sbatch──▶ queued ──▶ running ──▶ gone from the queue ──▶ poll() gives its end
///                           ▲           │              │
///                           └───────────┘              └ while a process holds the run's folder:
///                            node lost: --requeue        not yet ended
///
/// A task whose node was lost is started again on another node, while its first process may still
/// be running. Because of `run --once`, the folder's lock lets only one of them write, and the
/// other uses that result. Each submission is noted before and after it is made, so that after this
/// process was killed its successor finds the jobs.
class SlurmEngine final : public Engine {
 public:
  struct Settings {
    results::campaign::SlurmSettings slurm;
    /// Most parallel runs; none: as many as the cluster has room for.
    std::optional<int> at_once;
    std::filesystem::path folder;  ///< For scripts and Slurm's output; made when needed. Absolute.
  };

  /// To be called before anything is written; writes nothing itself.
  /// @throws UsageError  Slurm's commands are missing, or no cluster answers.
  static void require();

  /// @throws std::runtime_error  the cluster does not answer, or a note is malformed.
  SlurmEngine(Settings settings, slurm::Notes notes);

  std::string_view name() const override { return "slurm"; }
  std::vector<std::int64_t> adopt(std::span<const CampaignTask> started) override;
  std::size_t room() const override;
  void start(std::span<const CampaignTask> tasks) override;
  std::size_t running() const override;
  std::size_t slots() const override;
  std::vector<TaskEnd> poll(hal::Duration longest) override;

  /// Leaves the jobs with Slurm and prints that.
  void stop() override;
  bool outlives_stop() const override { return true; }

 private:
  /// A task that is queued or running, or that still runs after its node was lost.
  struct Active {
    CampaignTask task;
    std::optional<slurm::QueuedTask> place;  ///< None: not in the queue.
    std::optional<hal::Time> gone_since;     ///< Since when it is neither queued nor running.
  };

  /// Tasks in the queue by name of the job and index.
  using Places = std::map<std::pair<std::string, int>, slurm::QueuedTask>;

  void submit_unsent();
  bool submit(std::size_t count);
  void sent(std::size_t count, std::int64_t job);
  bool cannot_send(std::size_t count, const hal::Error& why);
  std::size_t next_count() const;
  std::vector<TaskEnd> look();
  static bool find_again(Active& active, const Places& places);
  std::optional<TaskEnd> end_of(Active& active);
  void tell_why_all_wait();
  void say(const std::string& what);

  Settings settings_;
  slurm::Submissions submissions_;
  slurm::Cluster cluster_;
  int first_bad_index_;
  std::vector<CampaignTask> unsent_;
  /// Most tasks to submit in one array: halved when the cluster refuses an array, doubled when it
  /// accepts one, at most first_bad_index_.
  std::size_t most_in_one_;
  std::map<std::int64_t, Active> active_;  ///< By run.
  int slots_ = 1;
  hal::Time next_look_{}, next_try_{};
  std::string said_;  ///< The last message, which is not repeated.
};

/// Cancels the queued and running jobs of a campaign and waits until they have ended.
/// @return number of tasks. @throws UsageError, std::runtime_error
std::size_t cancel_slurm_jobs(const slurm::Notes& notes);

}  // namespace baraka::campaign
