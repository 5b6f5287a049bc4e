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

/// Brings the runs of a campaign's database to their ends: hands those that wait to an engine, and
/// writes what became of each in one transaction. A run counts when that is in the database; one
/// that was under way when the process died is collected if its result is whole, and else done
/// again.
class CampaignLoop {
 public:
  struct Settings {
    results::campaign::Keep keep = results::campaign::Keep::kNone;
    bool retry_failed = false;
    int replications = 1;                    ///< Those above are left as they are.
    bool results_are_folders = false;        ///< A run whose folder has gone is done again.
    std::vector<std::string> run_arguments;  ///< Of `baraka run`, behind scenario, seed and folder.
    CampaignProgress::Settings progress;
  };
  struct Parts {
    results::campaign::CampaignDatabase& database;
    const CampaignFolder& folder;
    Engine& engine;
  };

  /// @param parts  outlive the loop. @throws std::runtime_error
  CampaignLoop(Parts parts, Settings settings);

  /// Until all have ended or the user interrupts.
  /// @throws DiskFull, std::runtime_error  it cannot go on; the same again goes on from there.
  void run();

  /// How many had ended before.
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
