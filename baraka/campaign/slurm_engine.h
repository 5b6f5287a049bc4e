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

/// Runs tasks on the nodes of a cluster, as array jobs of Slurm. The campaign's folder is on a file
/// system that this computer and the nodes share, and its locks (FolderLock) hold among them.
///
///   start()   ──sbatch──▶ queued ──▶ running ──▶ gone from the queue ──▶ poll() gives its end
///                           ▲           │              │
///                           └───────────┘              └ while a process holds the run's folder:
///                            node lost: --requeue        not yet ended
///
/// A task whose node was lost starts again on another one, while its first process may live on:
/// with `run --once`, the folder's lock lets one of them write, and the other takes its result.
/// What was submitted is noted before and after, so that the jobs live on when this process is
/// killed, and its successor finds them.
class SlurmEngine final : public Engine {
 public:
  struct Settings {
    results::campaign::SlurmSettings slurm;
    /// Most runs at a time; none: as many as the cluster has room for.
    std::optional<int> at_once;
    std::filesystem::path folder;  ///< For scripts and what Slurm says; made when needed. Absolute.
  };

  /// @throws UsageError  Slurm's commands are missing, or no cluster answers. Writes nothing: to be
  ///   called before anything is written.
  static void require();

  /// @throws std::runtime_error  the cluster does not answer, or a note is not as it should be.
  SlurmEngine(Settings settings, slurm::Notes notes);

  std::string_view name() const override { return "slurm"; }
  std::vector<std::int64_t> adopt(std::span<const CampaignTask> started) override;
  std::size_t room() const override;
  void start(std::span<const CampaignTask> tasks) override;
  std::size_t running() const override;
  std::size_t slots() const override;
  std::vector<TaskEnd> poll(hal::Duration longest) override;

  /// Leaves the jobs where they are, and says so.
  void stop() override;
  bool outlives_stop() const override { return true; }

 private:
  /// Queued or running, or what a lost node has left running.
  struct Active {
    CampaignTask task;
    std::optional<slurm::QueuedTask> place;  ///< None: in no queue.
    std::optional<hal::Time> gone_since;     ///< Seen in no queue and nowhere running.
  };

  /// By name of the job and index.
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
  std::size_t most_in_one_;  ///< Tasks of an array that the cluster took last, or all it may have.
  std::map<std::int64_t, Active> active_;  ///< By run.
  int slots_ = 1;
  hal::Time next_look_{}, next_try_{};
  std::string said_;  ///< Last; not said again.
};

/// Takes the jobs of a campaign out of the queue and ends those that run, and waits until they have
/// ended. @return how many tasks. @throws UsageError, std::runtime_error
std::size_t cancel_slurm_jobs(const slurm::Notes& notes);

}  // namespace baraka::campaign
