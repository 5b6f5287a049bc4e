#include "baraka/campaign/campaign_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "baraka/run/pace/interrupts.h"

namespace baraka::campaign {
namespace {

using namespace std::chrono_literals;
using results::campaign::CampaignReader;
using results::campaign::Keep;
using results::campaign::RunRow;
using results::campaign::RunState;

}  // namespace

CampaignLoop::CampaignLoop(Parts parts, Settings settings)
    : parts_(parts), settings_(std::move(settings)), progress_(settings_.progress) {
  resume();
}

CampaignTask CampaignLoop::task_of(const RunPlan& run) const {
  const CampaignFolder& folder = parts_.folder;
  const std::filesystem::path result = std::filesystem::absolute(folder.result_of(run));
  CampaignTask task{
      .run = run.run,
      .name = folder.name_of(run),
      .arguments = {"run", std::filesystem::absolute(folder.scenario_of(run.point)).string(),
                    "--seed", std::to_string(run.seed), "--out", result.string(), "--overwrite"},
      .folder = result,
      .log = std::filesystem::absolute(folder.log_of(run))};
  task.arguments.insert(task.arguments.end(), settings_.run_arguments.begin(),
                        settings_.run_arguments.end());
  return task;
}

bool CampaignLoop::is_to_do(const RunRow& row) const {
  if (row.state == RunState::kFailed) return settings_.retry_failed;
  if (row.state != RunState::kDone) return true;
  return settings_.results_are_folders && !collect_finished(parts_.folder, row.plan);
}

/// Collects a run whose process ended well after the campaign's process had died. @return whether
/// there is such a result.
bool CampaignLoop::collect_whole(const RunRow& row) {
  if (row.state == RunState::kFailed) return false;  // it will be repeated
  auto collected = collect_finished(parts_.folder, row.plan);
  if (!collected) return false;
  commit(*collected);
  keep(collected->row);
  return true;
}

/// Whether nothing is left to do for a run; completes what an earlier process left undone.
bool CampaignLoop::is_settled(const RunRow& row) {
  if (is_to_do(row)) return collect_whole(row);
  keep(row);
  // The earlier process was killed after the transaction, before it removed the folder.
  if (row.folder.empty() && row.state != RunState::kFailed) parts_.folder.remove(row.plan);
  return true;
}

void CampaignLoop::keep(const RunRow& row) {
  progress_.on_earlier(row);
  ++kept_;
}

/// Determines the runs to do.
void CampaignLoop::resume() {
  std::vector<RunRow> started;
  std::vector<std::int64_t> again;
  for (RunRow& row : CampaignReader(parts_.folder.path()).runs()) {
    if (row.plan.replication > settings_.replications) continue;
    if (is_settled(row)) continue;
    waiting_.push_back(row.plan);
    if (row.state == RunState::kDone || row.state == RunState::kFailed) {
      again.push_back(row.plan.run);
    }
    if (row.state == RunState::kRunning) started.push_back(std::move(row));
  }
  if (!again.empty()) parts_.database.reset(again);
  adopt(started);
  std::vector<RunPlan> to_do;
  for (const auto& [number, run] : running_) to_do.push_back(run);
  to_do.insert(to_do.end(), waiting_.begin(), waiting_.end());
  progress_.set_waiting(to_do);
  for (const auto& [number, run] : running_) {
    progress_.on_start(run, CampaignProgress::Clock::now());
  }
}

void CampaignLoop::adopt(const std::vector<RunRow>& started) {
  std::vector<CampaignTask> tasks;
  std::vector<std::int64_t> lost;
  tasks.reserve(started.size());
  for (const RunRow& row : started) tasks.push_back(task_of(row.plan));
  const std::vector<std::int64_t> adopted = parts_.engine.adopt(tasks);
  for (const RunRow& row : started) {
    if (std::ranges::find(adopted, row.plan.run) == adopted.end()) {
      lost.push_back(row.plan.run);
    } else {
      running_[row.plan.run] = row.plan;
    }
  }
  std::erase_if(waiting_, [&](const RunPlan& run) { return running_.contains(run.run); });
  if (!lost.empty()) parts_.database.reset(lost);
}

void CampaignLoop::run() {
  try {
    while (!(waiting_.empty() && running_.empty()) && !run::pace::interrupted()) {
      start_some();
      progress_.show(CampaignProgress::Clock::now(), parts_.engine.running());
      for (const TaskEnd& end : parts_.engine.poll(250ms)) finish(end);
    }
  } catch (...) {
    progress_.end();
    parts_.engine.stop();
    throw;
  }
  progress_.end();
  if (running_.empty()) return;
  parts_.engine.stop();
  if (!parts_.engine.outlives_stop()) collect_what_is_whole();
}

void CampaignLoop::start_some() {
  const std::size_t count = std::min(parts_.engine.room(), waiting_.size());
  if (count == 0) return;
  std::vector<CampaignTask> tasks;
  std::vector<std::int64_t> runs;
  for (std::size_t i = 0; i < count; ++i) {
    tasks.push_back(task_of(waiting_[i]));
    runs.push_back(waiting_[i].run);
  }
  parts_.database.start(runs, utc_now());
  parts_.engine.start(tasks);
  for (std::size_t i = 0; i < count; ++i) {
    const RunPlan run = waiting_.front();
    waiting_.pop_front();
    running_[run.run] = run;
    progress_.on_start(run, CampaignProgress::Clock::now());
  }
}

void CampaignLoop::finish(const TaskEnd& end) {
  const RunPlan run = running_.at(end.run);
  CollectedRun collected = collect(parts_.folder, run, end);
  if (collected.row.state == RunState::kFailed) require_room(parts_.folder, collected.row.error);
  commit(collected);
  running_.erase(run.run);
  progress_.on_end(collected.row, parts_.folder.name_of(run), CampaignProgress::Clock::now());
}

/// Whether a run's folder is kept; if so, notes its path in the row.
bool CampaignLoop::keeps_folder(CollectedRun& collected) const {
  const bool failed = collected.row.state == RunState::kFailed;
  const bool keeps = settings_.keep == Keep::kAll || (settings_.keep == Keep::kFailed && failed);
  if (keeps) {
    collected.row.folder =
        parts_.folder.left_by(collected.row.plan).lexically_relative(parts_.folder.path()).string();
  }
  return keeps;
}

/// Records a run in the database and then removes its folder unless it is kept. If the database
/// refuses the measurements of a run, that run fails and the others go on.
void CampaignLoop::commit(CollectedRun& collected) {
  bool keeps = keeps_folder(collected);
  try {
    parts_.database.finish(collected.row, collected.measured);
  } catch (const std::runtime_error& error) {
    require_room(parts_.folder, error.what());
    if (collected.row.state == RunState::kFailed) throw;
    fail(collected, error.what());
    keeps = keeps_folder(collected);
    parts_.database.finish(collected.row, collected.measured);
  }
  if (keeps) return;
  // The database holds only the last error message; earlier ones are in the log, so that stays.
  if (collected.row.state == RunState::kFailed) {
    parts_.folder.remove_result_of(collected.row.plan);
  } else {
    parts_.folder.remove(collected.row.plan);
  }
}

/// Some runs may have ended just before they were stopped.
void CampaignLoop::collect_what_is_whole() {
  for (const auto& [number, run] : running_) {
    auto collected = collect_finished(parts_.folder, run);
    if (collected) commit(*collected);
  }
}

}  // namespace baraka::campaign
