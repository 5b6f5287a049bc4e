#include "baraka/fleet/fleet_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

#include "baraka/campaign/campaign_command.h"
#include "baraka/campaign/campaign_status.h"
#include "baraka/campaign/check_campaign.h"
#include "baraka/campaign/slurm_campaign.h"
#include "baraka/fleet/fleet_needs.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/terminal_colours.h"
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
  fs::path scenario;
  FleetFile file;
  FleetPlan plan;
};

enum class Numbers : std::uint8_t { kAll, kExtremes };

LoadedFleet load(const std::string& path, const std::vector<std::string>& overrides,
                 Numbers numbers = Numbers::kAll) {
  LoadedFleet fleet;
  fleet.path = hal::files::config::named_file(path, {"fleets"});
  fleet.file = results::fleet::load_fleet(fleet.path, overrides);
  std::vector<int>& robots = fleet.file.robots;
  if (numbers == Numbers::kExtremes && robots.size() > 2)
    robots.erase(robots.begin() + 1, robots.end() - 1);
  results::campaign::CampaignFile named;
  named.scenario = fleet.file.scenario;
  named.scenario_place = fleet.file.scenario_place;
  fleet.scenario = campaign::scenario_file(named, fleet.path);
  fleet.plan = results::fleet::plan_of(fleet.file,
                                       results::fleet::fleet_scenario(fleet.scenario, fleet.file));
  return fleet;
}

/// @throws ConfigErrors  a case has mistakes, or a need is about nothing.
campaign::CheckedCampaign checked(const LoadedFleet& fleet) {
  campaign::CheckedCampaign all = campaign::check_points(fleet.plan.campaign, fleet.path);
  std::vector<std::string> needs = unmatched_needs(fleet.file, fleet.plan, fleet.scenario);
  if (!needs.empty()) throw hal::files::config::ConfigErrors(std::move(needs));
  return all;
}

/// The runs of a case that have ended well, and how many failed.
struct CaseRuns {
  std::vector<results::fleet::FleetRun> runs;
  std::size_t failed = 0;
};

void add_run(const fs::path& folder, const RunRow& run, const FleetFile& fleet, CaseRuns& into) {
  if (run.state == RunState::kFailed) ++into.failed;
  if (run.state != RunState::kDone) return;
  try {
    into.runs.push_back(results::fleet::read_fleet_run(folder / run.folder, fleet));
  } catch (const std::runtime_error& e) {
    hal::print_line(hal::Tone::kWarning, fmt::format("left out: {}", e.what()));
    ++into.failed;
  }
}

/// The runs of the folder, by the labels of their points: more points may have been added since.
std::map<std::string, CaseRuns> runs_by_label(const fs::path& folder, const FleetFile& fleet) {
  CampaignReader reader(folder);
  std::map<int, std::string> labels;
  for (const auto& point : reader.points()) labels[point.point] = point.label;
  std::map<std::string, CaseRuns> cases;
  for (const RunRow& run : reader.runs()) {
    if (run.plan.replication > fleet.replications) continue;
    add_run(folder, run, fleet, cases[labels[run.plan.point]]);
  }
  return cases;
}

std::vector<results::fleet::FleetLine> answer(const LoadedFleet& fleet, const fs::path& folder) {
  std::map<std::string, CaseRuns> found = runs_by_label(folder, fleet.file);
  std::vector<results::fleet::CaseAnswer> cases;
  for (std::size_t i = 0; i < fleet.plan.cases.size(); ++i) {
    const CaseRuns& one = found[fleet.plan.campaign.labels[i]];
    cases.push_back(
        results::fleet::answer_of(fleet.file, fleet.plan.cases[i], one.runs, one.failed));
  }
  return results::fleet::lines_of(std::move(cases));
}

/// @throws ConfigErrors  the folder's runs of a case are of another scenario, or it has none.
void require_same(const campaign::CheckedCampaign& wanted, const fs::path& folder) {
  std::map<std::string, std::string> scenarios;
  for (const auto& point : CampaignReader(folder).points()) scenarios[point.label] = point.scenario;
  for (const auto& point : wanted.table.points) {
    const auto found = scenarios.find(point.label);
    if (found != scenarios.end() && found->second == point.scenario) continue;
    throw hal::files::config::ConfigErrors({fmt::format(
        "{}: {} case '{}' of the fleet file; without --status its runs are carried out",
        folder.string(), found == scenarios.end() ? "has no" : "has another", point.label)});
  }
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
  const campaign::CheckedCampaign wanted = checked(fleet);
  if (options.status) {
    require_same(wanted, folder);
    const int status = campaign::print_status(folder);
    write_answer(fleet, folder);
    return status;
  }
  CampaignOptions own = options;
  own.tells_points = false;
  const int status = campaign::run_checked(wanted, fleet.path, own);
  write_answer(fleet, folder);
  return status;
}

std::vector<std::string> check_fleet(const std::string& path,
                                     const std::vector<std::string>& overrides) {
  // What is wrong with a number of robots is wrong with the least or with the greatest one.
  return checked(load(path, overrides, Numbers::kExtremes)).warnings;
}

}  // namespace baraka::fleet
