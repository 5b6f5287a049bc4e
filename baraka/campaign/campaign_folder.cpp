#include "baraka/campaign/campaign_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "baraka/campaign/run_name.h"
#include "baraka/run/output/folder_lock.h"
#include "baraka/run/output/result_marker.h"
#include "baraka/run/output/results_folder.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/errors.h"
#include "results/campaign/campaign_reader.h"
#include "results/campaign/extension.h"
#include "sim/scenario/plot_request.h"

namespace baraka::campaign {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = ".new";
constexpr const char* kNotBegun = ".not-started";  // as in results_folder.h

std::string content_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Removes a half-written file that a killed process left.
void remove_half(const fs::path& half) {
  constexpr std::string_view kStart = "# version: ";
  const std::string begun = content_of(half);
  if (fs::is_regular_file(fs::symlink_status(half)) &&
      begun.starts_with(kStart.substr(0, begun.size()))) {
    fs::remove(half);
  }
}

}  // namespace

CampaignFolder::CampaignFolder(const fs::path& path, const Settings& settings)
    : path_(run::output::folder_named(path)), layout_(settings.layout) {
  if (path_.has_parent_path()) run::output::make_folder(path_.parent_path());
  lock_.emplace(path_);
  run::output::finish_set_aside(path_);
  const bool has_replications = fs::exists(path_ / run::output::kReplicationsFile);
  if (has_replications || results::campaign::CampaignReader::has_database(path_)) {
    if (has_replications == (layout_ == Layout::kReplications)) return;
    throw gateway::process::UsageError(
        fmt::format("{}: holds {}; give another --out, or remove the folder", path_.string(),
                    has_replications ? "replications of one scenario (baraka run)"
                                     : "a campaign (baraka campaign)"));
  }
  remove_half(path_ / (std::string(run::output::kReplicationsFile) + kUnfinished));
  run::output::require_result_or_nothing(path_);
  const auto replaced = run::output::set_aside(path_, settings.overwrite);
  run::output::make_folder(path_);
  if (replaced && !settings.overwrite) {
    fmt::print(stderr, "the earlier result is kept: {}\n", replaced->string());
  } else if (replaced) {
    run::output::remove_result(*replaced);
  }
}

fs::path CampaignFolder::scenario_of(int point) const {
  if (layout_ == Layout::kReplications) return path_ / run::output::kReplicationsFile;
  return path_ / "points" / fmt::format("p{:03}.yaml", point);
}

std::string CampaignFolder::name_of(const results::campaign::RunPlan& run) const {
  return layout_ == Layout::kReplications ? replication_name(run) : campaign_run_name(run);
}

fs::path CampaignFolder::result_of(const results::campaign::RunPlan& run) const {
  return (layout_ == Layout::kReplications ? path_ : path_ / "runs") / name_of(run);
}

fs::path CampaignFolder::log_of(const results::campaign::RunPlan& run) const {
  return result_of(run).string() + ".log";
}

fs::path CampaignFolder::left_by(const results::campaign::RunPlan& run) const {
  const fs::path result = result_of(run), not_begun = result.string() + kNotBegun;
  return !fs::exists(result) && fs::exists(not_begun) ? not_begun : result;
}

void CampaignFolder::claim(int point, const std::string& scenario) const {
  const fs::path file = scenario_of(point);
  if (fs::exists(file)) {
    const std::string old = content_of(file);
    if (old == scenario) return;
    const std::string before = sim::scenario::without_report_only(old);
    const std::string now = sim::scenario::without_report_only(scenario);
    if (before != now) {
      throw hal::files::config::ConfigErrors(
          {fmt::format("{}: holds replications of another scenario: {}; give another --out, or "
                       "remove the folder",
                       path_.string(), results::campaign::first_difference(before, now))});
    }
  }
  run::output::make_folder(file.parent_path());
  const fs::path half = file.string() + kUnfinished;
  std::ofstream out(half);
  out << scenario;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", half.string()));
  fs::rename(half, file);
}

void CampaignFolder::remove(const results::campaign::RunPlan& run) const {
  remove_result_of(run);
  fs::remove(log_of(run));
}

void CampaignFolder::remove_result_of(const results::campaign::RunPlan& run) const {
  const fs::path result = result_of(run);
  for (const fs::path& folder : {result, fs::path(result.string() + kNotBegun)}) {
    if (fs::exists(folder)) run::output::remove_result(folder);
  }
  run::output::remove_lock_of_the_dead(result);
}

}  // namespace baraka::campaign
