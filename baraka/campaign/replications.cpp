#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "baraka/campaign/campaign_command.h"
#include "baraka/campaign/local_engine.h"
#include "baraka/campaign/program_digests.h"
#include "baraka/run/check/check_programs.h"
#include "baraka/run/check/check_scenario.h"
#include "baraka/run/domain_range.h"
#include "baraka/run/pace/interrupts.h"
#include "hal/files/config/errors.h"
#include "sim/scenario/plot_request.h"
#include "sim/scenario/resolved.h"

namespace baraka::campaign {
namespace {

void check_options(const run::RunOptions& options, std::uint64_t seed) {
  std::vector<std::string> mistakes;
  const auto last = static_cast<std::uint64_t>(*options.replications) - 1;
  if (seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) - last) {
    mistakes.push_back(
        fmt::format("--replications: from seed {}, there are no {} seeds", seed, last + 1));
  }
  if (options.jobs > 1 && options.controllers == run::controllers::ControllersFrom::kExternal) {
    mistakes.push_back(
        "--jobs: runs side by side need controllers of their own, so no --controllers external");
  }
  if (!mistakes.empty()) throw hal::files::config::ConfigErrors(std::move(mistakes));
}

/// The value of `--controllers`.
std::string_view name_of(run::controllers::ControllersFrom from) {
  switch (from) {
    case run::controllers::ControllersFrom::kSpawn:
      return "spawn";
    case run::controllers::ControllersFrom::kExternal:
      return "external";
    case run::controllers::ControllersFrom::kInProcess:
      return "in-process";
  }
  return {};
}

/// Arguments of `baraka run` for each replication, after scenario, seed and folder.
std::vector<std::string> arguments_of(const run::RunOptions& options) {
  std::vector<std::string> arguments{"--controllers", std::string(name_of(options.controllers))};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  if (options.until) add("--until", fmt::format("{}", *options.until));
  if (std::isfinite(options.max_speed)) add("--max-speed", fmt::format("{}", options.max_speed));
  add("--log", options.log);
  if (options.inspect_domain) add("--inspect-domain", std::to_string(*options.inspect_domain));
  if (!options.inspect) arguments.emplace_back("--no-inspect");
  return arguments;
}

results::campaign::WantedRuns wanted_of(const run::RunOptions& options,
                                        const sim::scenario::Scenario& scenario) {
  const std::uint64_t seed = scenario.simulation.seed;
  results::campaign::PointRow point;
  point.scenario = sim::scenario::resolved_yaml(scenario);
  return {.values = {{"name", scenario.name},
                     {"version", BARAKA_VERSION},
                     {"scenario", options.scenario},
                     {"design", std::string(name_of(results::campaign::Design::kOnePoint))},
                     {"base_seed", std::to_string(seed)},
                     {"replications", std::to_string(*options.replications)},
                     {"seeds", std::string(name_of(results::campaign::Seeds::kCommon))},
                     {"until", run::until_words(options)},
                     {"programs",
                      program_digests(controllers_of(scenario), run::check::input_files(scenario))},
                     {"controllers", std::string(name_of(options.controllers))}},
          .factors = {},
          .points = {std::move(point)},
          .replications = *options.replications,
          .seeds = results::campaign::Seeds::kCommon,
          .base_seed = seed,
          .essence = sim::scenario::without_report_only,
          .may_be_fewer = true};
}

}  // namespace

int run_replications(const run::RunOptions& options) {
  const sim::scenario::Scenario scenario =
      run::check::load_checked(options.scenario, options.overrides, run::run_mode_of(options));
  check_options(options, scenario.simulation.seed);
  const LocalEngine::Settings settings{.jobs = options.jobs,
                                       .domains = run::domains_for(options.domain, options.jobs)};
  run::pace::catch_interrupts();
  const CampaignFolder folder(
      run::results_path(options, scenario.name),
      {.layout = CampaignFolder::Layout::kReplications, .overwrite = options.overwrite});
  CampaignWork work{.wanted = wanted_of(options, scenario), .loop = {}};
  folder.claim(1, fmt::format("# version: {}\n# until: {}\n{}", BARAKA_VERSION,
                              run::until_words(options), work.wanted.points.front().scenario));
  work.loop.keep = results::campaign::Keep::kAll;
  work.loop.retry_failed = true;
  work.loop.results_are_folders = true;
  work.loop.run_arguments = arguments_of(options);
  work.loop.progress.every_run = true;
  const auto engine = [&settings](results::campaign::CampaignDatabase& /*database*/) {
    return std::make_unique<LocalEngine>(settings);
  };
  return do_campaign(folder, engine, std::move(work));
}

}  // namespace baraka::campaign
