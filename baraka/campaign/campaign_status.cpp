#include "baraka/campaign/campaign_status.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <utility>
#include <vector>

#include "baraka/campaign/campaign_progress.h"
#include "baraka/campaign/run_name.h"
#include "baraka/run/output/folder_lock.h"
#include "baraka/run/output/results_folder.h"
#include "gateway/process/exit_status.h"
#include "hal/types/printable.h"
#include "results/campaign/campaign_file.h"

namespace baraka::campaign {
namespace {

using results::campaign::CampaignReader;
using results::campaign::PointRow;
using results::campaign::RunRow;
using results::campaign::RunState;

/// Counts of one point.
struct PointSums {
  std::size_t runs = 0, done = 0, failed = 0;
  double simulated = 0, wall = 0;  ///< Sums over the done runs, s.
  std::map<std::string, std::size_t> results;
};

void add(PointSums& sums, const RunRow& row) {
  ++sums.runs;
  if (row.state == RunState::kFailed) ++sums.failed;
  if (row.state != RunState::kDone) return;
  ++sums.done;
  ++sums.results[row.result];
  sums.simulated += row.simulated_s.value_or(0);
  sums.wall += row.wall_s.value_or(0);
}

std::string words_of(const std::map<std::string, std::size_t>& results) {
  std::string words;
  for (const auto& [result, count] : results) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, hal::printable(result));
  }
  return words;
}

std::string line_of(const PointRow& point, const PointSums& sums, std::size_t width) {
  const auto mean = [&](double sum) {
    return sums.done == 0 ? std::string("-")
                          : fmt::format("{:.2f}", sum / static_cast<double>(sums.done));
  };
  return fmt::format("{:>5}  {:<{}}  {:>5}  {:>5}  {:>6}  {:>11}  {:>8}  {}\n", point.point,
                     hal::printable(point.label), width, sums.runs, sums.done, sums.failed,
                     mean(sums.simulated), mean(sums.wall), words_of(sums.results));
}

std::string table_of(const std::vector<PointRow>& points, const std::map<int, PointSums>& sums) {
  std::size_t width = 5;
  for (const PointRow& point : points) width = std::max(width, point.label.size());
  std::string table =
      fmt::format("{:>5}  {:<{}}  {:>5}  {:>5}  {:>6}  {:>11}  {:>8}  {}\n", "point", "label",
                  width, "runs", "done", "failed", "simulated s", "wall s", "results");
  for (const PointRow& point : points) {
    const auto found = sums.find(point.point);
    table += line_of(point, found == sums.end() ? PointSums{} : found->second, width);
  }
  return table;
}

/// "": the runs are in lock-step.
std::string pace_line(const std::string& pace) {
  if (pace.empty() || pace == results::campaign::kLockstep) return "";
  return fmt::format("in real time ({}): runs of equal seeds differ\n", hal::printable(pace));
}

std::string bad_end(const RunRow& row, const std::string& name) {
  const bool failed = row.state == RunState::kFailed;
  return fmt::format("{}: {} (seed {}): {}\n", failed ? "failed" : "expectation not met", name,
                     row.plan.seed, hal::printable(failed ? row.error : row.result));
}

void count(CampaignStatus& status, const RunRow& row, const std::string& name) {
  ++status.runs;
  status.waiting += row.state == RunState::kWaiting ? 1 : 0;
  status.running += row.state == RunState::kRunning ? 1 : 0;
  status.failed += row.state == RunState::kFailed ? 1 : 0;
  status.done += row.state == RunState::kDone ? 1 : 0;
  if (row.state == RunState::kDone) ++status.results[row.result];
  const bool unmet = row.state == RunState::kDone && row.expectations_met == false;
  status.unmet += unmet ? 1 : 0;
  if (unmet || row.state == RunState::kFailed) status.bad_ends += bad_end(row, name);
}

/// Seconds since a time written as in the database; 0 if the text is not a time.
double seconds_since(const std::string& utc) {
  std::tm parts{};
  if (::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) == nullptr) return 0;
  return std::difftime(std::time(nullptr), ::timegm(&parts));
}

std::string estimate_of(CampaignReader& reader, bool is_running) {
  TimeLeftEstimate estimate;
  std::vector<TimeLeftEstimate::Running> running;
  std::vector<int> waiting;
  for (const RunRow& row : reader.runs()) {
    if (row.state == RunState::kDone && row.wall_s) estimate.add(row.plan.point, *row.wall_s);
    if (row.state == RunState::kWaiting) waiting.push_back(row.plan.point);
    if (row.state != RunState::kRunning) continue;
    if (is_running) running.push_back({row.plan.point, seconds_since(row.started)});
    if (!is_running) waiting.push_back(row.plan.point);
  }
  if (running.empty() && waiting.empty()) return "";
  const auto left = estimate.left(running, waiting, std::max<std::size_t>(1, running.size()));
  return left ? words_of(*left) : "";
}

}  // namespace

CampaignStatus status_of(CampaignReader& reader, int replications) {
  const bool is_one_point =
      std::filesystem::exists(reader.folder() / run::output::kReplicationsFile);
  CampaignStatus status;
  std::map<int, PointSums> sums;
  for (const RunRow& row : reader.runs()) {
    if (row.plan.replication > replications) continue;
    add(sums[row.plan.point], row);
    count(status, row, is_one_point ? replication_name(row.plan) : campaign_run_name(row.plan));
  }
  const std::vector<PointRow> points = reader.points();
  status.points = points.size();
  status.table = table_of(points, sums) + pace_line(reader.value("pace"));
  return status;
}

int print_status(const std::filesystem::path& folder) {
  if (!CampaignReader::has_database(folder)) {
    throw gateway::process::UsageError(fmt::format(
        "{}: no campaign has begun there; give --out if it is elsewhere", folder.string()));
  }
  CampaignReader reader(folder);
  const bool is_running = run::output::is_held(run::output::folder_named(folder));
  const CampaignStatus status = status_of(reader, std::numeric_limits<int>::max());
  fmt::print("{}", status.table);
  fmt::print(stderr, "{}", status.bad_ends);
  fmt::print("campaign: {}\nunder_way: {}\n", hal::printable(reader.value("name")),
             is_running ? "yes" : "no");
  fmt::print("points: {}\nruns: {}\nwaiting: {}\nrunning: {}\nfinished: {}\nfailed: {}\n",
             status.points, status.runs, status.waiting + (is_running ? 0 : status.running),
             is_running ? status.running : 0, status.done, status.failed);
  if (const std::string left = estimate_of(reader, is_running); !left.empty()) {
    fmt::print("estimate: {}\n", left);
  }
  return gateway::process::kDone;
}

}  // namespace baraka::campaign
