#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "baraka/campaign/campaign_folder.h"
#include "baraka/campaign/campaign_progress.h"
#include "baraka/campaign/collect.h"
#include "baraka/campaign/engine.h"
#include "results/campaign/campaign_database.h"
#include "results/campaign/campaign_file.h"
#include "results/campaign/campaign_reader.h"

namespace baraka::campaign {

/// Carries out the runs of a campaign's database: passes waiting runs to an engine, and records
/// each ended run in one transaction. Only then the run counts. A run that was under way when this
/// process died is collected if its result is complete, and otherwise repeated.
class CampaignLoop {
 public:
  struct Settings {
    results::campaign::Keep keep = results::campaign::Keep::kNone;
    bool retry_failed = false;
    int replications = 1;              ///< Runs with a higher replication number are left alone.
    bool results_are_folders = false;  ///< Repeat a finished run whose folder is gone.
    /// Arguments of `baraka run` after scenario, seed and folder.
    std::vector<std::string> run_arguments;
    CampaignProgress::Settings progress;
  };
  struct Parts {
    results::campaign::CampaignDatabase& database;
    const CampaignFolder& folder;
    Engine& engine;
  };

  /// @param parts  must outlive the loop. @throws std::runtime_error
  CampaignLoop(Parts parts, Settings settings);

  /// Runs until all runs have ended or the user interrupts.
  /// @throws DiskFull, std::runtime_error  the campaign cannot go on; a new process can continue
  /// it.
  void run();

  /// Number of runs that had ended before.
  std::size_t kept() const { return kept_; }

 private:
  using RunPlan = results::campaign::RunPlan;

  bool is_to_do(const results::campaign::RunRow& row) const;
  CampaignTask task_of(const RunPlan& run) const;
  void resume();
  bool is_settled(const results::campaign::RunRow& row);
  bool collect_whole(const results::campaign::RunRow& row);
  void keep(const results::campaign::RunRow& row);
  void adopt(const std::vector<results::campaign::RunRow>& started);
  void start_some();
  void finish(const TaskEnd& end);
  bool keeps_folder(CollectedRun& collected) const;
  void commit(CollectedRun& collected);
  void collect_what_is_whole();

  Parts parts_;
  Settings settings_;
  CampaignProgress progress_;
  std::deque<RunPlan> waiting_;
  std::map<std::int64_t, RunPlan> running_;
  std::size_t kept_ = 0;
};

}  // namespace baraka::campaign
