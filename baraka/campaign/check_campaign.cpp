#include "baraka/campaign/check_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "baraka/campaign/default_levels.h"
#include "baraka/campaign/program_digests.h"
#include "baraka/run/check/check_programs.h"
#include "baraka/run/check/check_scenario.h"
#include "baraka/run/check/program_pace.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"
#include "results/campaign/latin_hypercube.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace baraka::campaign {
namespace {

namespace fs = std::filesystem;

using hal::files::config::ConfigErrors;
using results::campaign::CampaignFile;
using results::campaign::DesignPoint;
using results::campaign::FactorValue;
using results::campaign::PointRow;
using results::campaign::RunControllers;
using sim::scenario::Scenario;

std::uint64_t seed_in(const fs::path& scenario) {
  auto document = hal::files::config::Document::load(scenario);
  return static_cast<std::uint64_t>(document.root().integer(
      {"seed", "As of a scenario.", "1"}, 0, std::numeric_limits<std::int64_t>::max(), 1));
}

/// A text as ConfigErrors writes it: for example, a tab in a key becomes \x09.
std::string as_told(const std::string& words) { return ConfigErrors({words}).messages().front(); }

/// Collects the mistakes of the points, to report each once, at the place of its cause.
class PointMistakes {
 public:
  explicit PointMistakes(std::size_t points) : points_(points) {}

  void add(const DesignPoint& point, const PointRow& row, const std::vector<std::string>& lines) {
    const std::string which =
        row.label.empty() ? "" : fmt::format("point {}: {}", row.point, row.label);
    for (const std::string& line : lines) {
      if (const auto own = of_a_value(point, line)) {
        note(*own, which);
      } else {
        const std::string& place = point.empty() ? std::string() : point.front().place;
        others_[line].push_back({place, which});
      }
    }
  }

  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    for (const auto& [line, where] : others_) {
      // A mistake that every point has is one of the scenario itself.
      if (where.size() == points_) {
        all.push_back(line);
      } else {
        all.push_back(fmt::format("{}: {} ({})", where.front().place, line, where.front().which));
      }
    }
    for (const auto& [line, which] : of_values_) all.push_back(fmt::format("{} ({})", line, which));
    return all;
  }

 private:
  struct Where {
    std::string place, which;
  };

  void note(const std::string& line, const std::string& which) {
    if (seen_.insert(line).second) of_values_.emplace_back(line, which);
  }

  /// Rewrites a mistake "--set KEY: …" with the place of the value; none: another kind of mistake.
  static std::optional<std::string> of_a_value(const DesignPoint& point, const std::string& line) {
    for (const FactorValue& value : point) {
      const std::string start = as_told("--set " + value.key + ": ");
      if (!line.starts_with(start)) continue;
      const std::string what = line.substr(start.size());
      const std::string last = value.key.substr(value.key.rfind('.') + 1);
      // A mistake inside the value, or in a parameter, already names the key.
      const bool says_key =
          what.starts_with(as_told(value.key + ".")) || what.starts_with(last + ": ");
      return fmt::format("{}: {}{}", value.place, says_key ? "" : as_told(value.key + ": "), what);
    }
    return std::nullopt;
  }

  std::size_t points_;
  std::map<std::string, std::vector<Where>> others_;
  std::set<std::string> seen_;
  std::vector<std::pair<std::string, std::string>> of_values_;
};

std::vector<std::string> overrides_of(const DesignPoint& point, std::uint64_t seed) {
  std::vector<std::string> overrides{fmt::format("seed={}", seed)};
  for (const FactorValue& value : point) overrides.push_back(value.key + "=" + value.yaml);
  return overrides;
}

bool has_network(const Scenario& scenario) {
  return std::ranges::any_of(scenario.simulation.agents,
                             [](const auto& agent) { return agent.network.has_value(); });
}

/// @throws ConfigErrors  its pace is none, or none for programs inside agents.
void check_pace(const CampaignFile& file, bool has_programs) {
  try {
    (void)run::check::real_time_factor(file.pace);
    if (has_programs) run::check::require_pace_for_programs(file.pace);
  } catch (const gateway::process::UsageError& e) {
    const std::string what = e.what();
    constexpr std::string_view kOption = "--";
    throw ConfigErrors({fmt::format("{}: {}", file.pace_place,
                                    what.starts_with(kOption) ? what.substr(2) : what)});
  }
}

run::check::RunMode mode_of(const CampaignFile& file) {
  check_pace(file, false);
  return {.controllers = file.controllers == RunControllers::kInProcess
                             ? run::controllers::ControllersFrom::kInProcess
                             : run::controllers::ControllersFrom::kSpawn,
          .time = run::check::program_time(file.pace)};
}

/// Whether controllers of a scenario run inside their agents' networks, where only processes can:
/// the results of `in-process` and `spawn` are equal, so all its controllers are spawned.
bool has_inside(const fs::path& file, const std::vector<std::string>& overrides) {
  try {
    return std::ranges::any_of(sim::scenario::load_scenario(file, overrides).groups,
                               &sim::scenario::Group::inside);
  } catch (const ConfigErrors&) {
    return false;  // reported with the mistakes of all points
  }
}

void set_labels(CheckedCampaign& campaign) {
  for (std::size_t i = 0; i < campaign.file.labels.size(); ++i) {
    campaign.table.points[i].label = campaign.file.labels[i];
  }
}

/// Checks the scenario of each point and completes the campaign's table.
void check_each(CheckedCampaign& campaign, const fs::path& scenario,
                const std::vector<DesignPoint>& points) {
  const run::check::RunMode mode = mode_of(campaign.file);
  PointMistakes mistakes(points.size());
  std::set<std::string> warnings;
  std::vector<std::vector<std::string>> defaults(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    PointRow& row = campaign.table.points[i];
    try {
      const run::check::CheckedScenario checked =
          run::check::check_scenario(scenario, overrides_of(points[i], campaign.seed), mode);
      const Scenario& one = checked.scenario;
      check_pace(campaign.file, has_network(one));
      warnings.insert(checked.remarks.begin(), checked.remarks.end());
      row.scenario = sim::scenario::resolved_yaml(one);
      campaign.controllers.merge(controllers_of(one));
      campaign.files.merge(run::check::input_files(one));
      const bool sets_all = points[i].size() == campaign.file.keys.size();
      if (!sets_all) defaults[i] = values_in(one, campaign.file.keys);
    } catch (const ConfigErrors& errors) {
      mistakes.add(points[i], row, errors.messages());
    }
  }
  std::vector<std::string> lines = mistakes.lines();
  if (!lines.empty()) throw ConfigErrors(std::move(lines));
  results::campaign::set_defaults(campaign.table, defaults);
  campaign.warnings.assign(warnings.begin(), warnings.end());
}

}  // namespace

fs::path scenario_file(const CampaignFile& campaign, const fs::path& file) {
  const fs::path beside = file.parent_path() / campaign.scenario;
  if (fs::exists(beside)) return beside.lexically_normal();
  try {
    return hal::files::config::named_file(campaign.scenario, {"scenarios"});
  } catch (const ConfigErrors& e) {
    throw ConfigErrors({fmt::format("{}: scenario: {}", campaign.scenario_place, e.what())});
  }
}

CheckedCampaign check_campaign(const std::string& path, const std::vector<std::string>& overrides) {
  const fs::path file = hal::files::config::named_file(path, {"campaigns"});
  return check_points(results::campaign::load_campaign(file, overrides), file);
}

CheckedCampaign check_points(CampaignFile of, const fs::path& file) {
  CheckedCampaign campaign;
  campaign.file = std::move(of);
  const fs::path scenario = scenario_file(campaign.file, file);
  campaign.seed = campaign.file.seed ? *campaign.file.seed : seed_in(scenario);
  const std::vector<DesignPoint> points =
      results::campaign::points_of(campaign.file, campaign.seed);
  campaign.table = results::campaign::factor_table(campaign.file.keys, points);
  if (!points.empty() && has_inside(scenario, overrides_of(points.front(), campaign.seed)))
    campaign.file.controllers = RunControllers::kSpawn;
  set_labels(campaign);
  check_each(campaign, scenario, points);
  set_labels(campaign);  // values of keys at their defaults are in the labels otherwise
  return campaign;
}

}  // namespace baraka::campaign
