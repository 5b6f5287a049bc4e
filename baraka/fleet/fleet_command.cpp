#include "baraka/fleet/fleet_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "baraka/campaign/campaign_command.h"
#include "baraka/campaign/campaign_status.h"
#include "baraka/campaign/check_campaign.h"
#include "baraka/campaign/slurm_campaign.h"
#include "hal/files/config/shared_folders.h"
#include "results/campaign/campaign_reader.h"
#include "results/fleet/fleet_answer.h"
#include "results/fleet/fleet_csv.h"
#include "results/fleet/fleet_file.h"
#include "results/fleet/fleet_page.h"
#include "results/fleet/fleet_points.h"
#include "results/fleet/fleet_text.h"

namespace baraka::fleet {
namespace {

namespace fs = std::filesystem;

using campaign::CampaignOptions;
using results::campaign::CampaignReader;
using results::campaign::RunRow;
using results::campaign::RunState;
using results::fleet::FleetFile;
using results::fleet::FleetPlan;

constexpr const char* kPage = "fleet.html";
constexpr const char* kTable = "fleet.csv";

struct LoadedFleet {
  fs::path path;
  FleetFile file;
  FleetPlan plan;
};

LoadedFleet load(const std::string& path, const std::vector<std::string>& overrides) {
  LoadedFleet fleet;
  fleet.path = hal::files::config::named_file(path, {"fleets"});
  fleet.file = results::fleet::load_fleet(fleet.path, overrides);
  results::campaign::CampaignFile named;
  named.scenario = fleet.file.scenario;
  named.scenario_place = fleet.file.scenario_place;
  const fs::path scenario = campaign::scenario_file(named, fleet.path);
  fleet.plan =
      results::fleet::plan_of(fleet.file, results::fleet::fleet_scenario(scenario, fleet.file));
  return fleet;
}

/// The runs of each point that have ended well, and how many failed.
struct PointRuns {
  std::vector<fs::path> folders;
  std::size_t failed = 0;
};

std::map<int, PointRuns> runs_by_point(const fs::path& folder) {
  std::map<int, PointRuns> points;
  for (const RunRow& run : CampaignReader(folder).runs()) {
    PointRuns& point = points[run.plan.point];
    if (run.state == RunState::kDone) point.folders.push_back(folder / run.folder);
    if (run.state == RunState::kFailed) ++point.failed;
  }
  return points;
}

std::vector<results::fleet::FleetLine> answer(const LoadedFleet& fleet, const fs::path& folder) {
  std::map<int, PointRuns> points = runs_by_point(folder);
  std::vector<results::fleet::CaseAnswer> cases;
  for (std::size_t i = 0; i < fleet.plan.cases.size(); ++i) {
    const PointRuns& point = points[static_cast<int>(i) + 1];
    std::vector<results::fleet::FleetRun> runs;
    for (const fs::path& one : point.folders) {
      runs.push_back(results::fleet::read_fleet_run(one, fleet.file));
    }
    cases.push_back(results::fleet::answer_of(fleet.file, fleet.plan.cases[i], runs, point.failed));
  }
  return results::fleet::lines_of(std::move(cases));
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{} cannot be written", file.string()));
}

void write_answer(const LoadedFleet& fleet, const fs::path& folder) {
  const auto lines = answer(fleet, folder);
  fmt::print("\n{}", results::fleet::fleet_text(fleet.file, lines));
  write(folder / kTable, results::fleet::fleet_csv(fleet.file, lines));
  write(folder / kPage, results::fleet::fleet_page(fleet.file, lines));
  fmt::print("page: {}\n", (folder / kPage).string());
}

fs::path folder_of(const LoadedFleet& fleet, const CampaignOptions& options) {
  return options.out.empty() ? fs::path("results") / fleet.file.name : fs::path(options.out);
}

}  // namespace

int run_fleet(const CampaignOptions& options) {
  const LoadedFleet fleet = load(options.file, options.overrides);
  const fs::path folder = folder_of(fleet, options);
  if (options.cancel) return campaign::cancel_campaign(folder);
  if (options.status) {
    const int status = campaign::print_status(folder);
    write_answer(fleet, folder);
    return status;
  }
  CampaignOptions own = options;
  own.tells_points = false;
  const int status = campaign::run_checked(campaign::check_points(fleet.plan.campaign, fleet.path),
                                           fleet.path, own);
  write_answer(fleet, folder);
  return status;
}

std::vector<std::string> check_fleet(const std::string& path,
                                     const std::vector<std::string>& overrides) {
  const LoadedFleet fleet = load(path, overrides);
  return campaign::check_points(fleet.plan.campaign, fleet.path).warnings;
}

}  // namespace baraka::fleet
