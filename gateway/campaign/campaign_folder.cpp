#include "gateway/campaign/campaign_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "gateway/campaign/run_name.h"
#include "gateway/exit_status.h"
#include "gateway/run/folder_lock.h"
#include "gateway/run/result_marker.h"
#include "gateway/run/results_folder.h"
#include "hal/config/errors.h"
#include "sim/campaign/campaign_reader.h"
#include "sim/campaign/extension.h"
#include "sim/report/plot_request.h"

namespace gateway {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = ".new";
constexpr const char* kNotBegun = ".not-started";  // as in results_folder.h

std::string content_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Half written by one that was killed.
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
    : path_(folder_named(path)), layout_(settings.layout) {
  if (path_.has_parent_path()) make_folder(path_.parent_path());
  lock_.emplace(path_);
  finish_set_aside(path_);
  const bool has_replications = fs::exists(path_ / kReplicationsFile);
  if (has_replications || sim::campaign::CampaignReader::has_database(path_)) {
    if (has_replications == (layout_ == Layout::kReplications)) return;
    throw UsageError(fmt::format("{}: holds {}; give another --out, or remove the folder",
                                 path_.string(),
                                 has_replications ? "replications of one scenario (baraka run)"
                                                  : "a campaign (baraka campaign)"));
  }
  remove_half(path_ / (std::string(kReplicationsFile) + kUnfinished));
  require_result_or_nothing(path_);
  const auto replaced = set_aside(path_, settings.overwrite);
  make_folder(path_);
  if (replaced && !settings.overwrite) {
    fmt::print(stderr, "the earlier result is kept: {}\n", replaced->string());
  } else if (replaced) {
    remove_result(*replaced);
  }
}

fs::path CampaignFolder::scenario_of(int point) const {
  if (layout_ == Layout::kReplications) return path_ / kReplicationsFile;
  return path_ / "points" / fmt::format("p{:03}.yaml", point);
}

std::string CampaignFolder::name_of(const sim::campaign::RunPlan& run) const {
  return layout_ == Layout::kReplications ? replication_name(run) : campaign_run_name(run);
}

fs::path CampaignFolder::result_of(const sim::campaign::RunPlan& run) const {
  return (layout_ == Layout::kReplications ? path_ : path_ / "runs") / name_of(run);
}

fs::path CampaignFolder::log_of(const sim::campaign::RunPlan& run) const {
  return result_of(run).string() + ".log";
}

fs::path CampaignFolder::left_by(const sim::campaign::RunPlan& run) const {
  const fs::path result = result_of(run), not_begun = result.string() + kNotBegun;
  return !fs::exists(result) && fs::exists(not_begun) ? not_begun : result;
}

void CampaignFolder::claim(int point, const std::string& scenario) const {
  const fs::path file = scenario_of(point);
  if (fs::exists(file)) {
    const std::string old = content_of(file);
    if (old == scenario) return;
    const std::string before = sim::report::without_report_only(old);
    const std::string now = sim::report::without_report_only(scenario);
    if (before != now) {
      throw hal::config::ConfigErrors(
          {fmt::format("{}: holds replications of another scenario: {}; give another --out, or "
                       "remove the folder",
                       path_.string(), sim::campaign::first_difference(before, now))});
    }
  }
  make_folder(file.parent_path());
  const fs::path half = file.string() + kUnfinished;
  std::ofstream out(half);
  out << scenario;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", half.string()));
  fs::rename(half, file);
}

void CampaignFolder::remove(const sim::campaign::RunPlan& run) const {
  remove_result_of(run);
  fs::remove(log_of(run));
}

void CampaignFolder::remove_result_of(const sim::campaign::RunPlan& run) const {
  const fs::path result = result_of(run);
  for (const fs::path& folder : {result, fs::path(result.string() + kNotBegun)}) {
    if (fs::exists(folder)) remove_result(folder);
  }
  remove_lock_of_the_dead(result);
}

}  // namespace gateway
