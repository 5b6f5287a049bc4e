#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "baraka/campaign/campaign_command.h"
#include "baraka/commands/wrong_kind.h"
#include "baraka/fleet/fleet_command.h"
#include "baraka/main/commands.h"
#include "baraka/main/controllers_option.h"
#include "baraka/run/domain_range.h"
#include "baraka/run/run_command.h"
#include "gateway/process/command_line.h"
#include "gateway/process/domains.h"

namespace baraka::main {
namespace {

using gateway::process::plain_number;
using gateway::process::seconds;
using gateway::process::whole_number;
using run::RunOptions;

constexpr std::int64_t kMostSeed = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostReplications = 1'000'000, kMostJobs = 1000, kMostPort = 65535;
constexpr double kLeastSpeed = 1e-6, kMostSpeed = 1e9;

/// Checks the value of an option that takes a DDS domain, "7", or a range of domains, "7-9".
CLI::Validator domains() {
  return {
      [](std::string& text) {
        return run::is_domain_range(text)
                   ? std::string{}
                   : fmt::format(
                         "'{}' is not a DDS domain from 0 to {}, nor a range of them such as 7-9",
                         text, gateway::process::kLastDomain);
      },
      fmt::format("0 to {}", gateway::process::kLastDomain)};
}

/// Adds the options of domains and files.
void add_surroundings(CLI::App* run, RunOptions& options) {
  run->add_option("--domain", options.domain,
                  "DDS domain; default: the first free one. With --jobs the first of as many, or "
                  "FIRST-LAST")
      ->transform(domains());
  run->add_option("--inspect-domain", options.inspect_domain,
                  "DDS domain to show the run in; default: the run's")
      ->transform(whole_number(0, gateway::process::kLastDomain));
  run->add_flag_callback(
      "--no-inspect", [&options] { options.inspect = false; }, "Do not show the run to DDS tools");
  run->add_option("--out", options.out, "Folder for the results; default: results/<name>");
  run->add_flag("--overwrite", options.overwrite,
                "Remove an earlier result there; default: keep it as <name>.1, .2, ...");
  run->add_flag("--once", options.once,
                "Keep a finished result of this seed there, and wait for another run that is "
                "writing there");
  run->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  run->add_option("--log", options.log, "Lowest level in run.log; default: info")
      ->transform(gateway::process::one_of({"debug", "info", "warning", "error"}));
}

/// @return --view.
CLI::Option* add_live_view(CLI::App* run, run::live::LiveViewOptions& view) {
  CLI::Option* shown = run->add_flag("--view", view.shown, "Show the run in a browser");
  run->add_flag("--paused", view.paused, "With --view: wait for the page to start the run")
      ->needs(shown);
  run->add_option("--view-port", view.port, "With --view: on this port; default: a free one")
      ->transform(whole_number(1, kMostPort))
      ->needs(shown);
  run->add_flag_callback(
         "--no-open", [&view] { view.open = false; }, "With --view: do not open a browser")
      ->needs(shown);
  return shown;
}

/// @param what  "campaign" or "fleet".
void add_campaign_options(CLI::App* command, campaign::CampaignOptions& options,
                          const std::string& what) {
  command->add_option("FILE", options.file, fmt::format("File of the {}", what))->required();
  command->add_option("--out", options.out, "Folder for the results; default: results/<name>");
  command->add_flag("--overwrite", options.overwrite,
                    "Remove an earlier result of a single run there");
  command
      ->add_option("--jobs", options.jobs,
                   "Runs at a time; default: as the file says, else one for each processor")
      ->transform(whole_number(1, kMostJobs));
  command->add_option("--set", options.overrides, fmt::format("KEY=VALUE of the {} file", what))
      ->allow_extra_args(false);
  command
      ->add_option("--engine", options.engine,
                   "Where runs execute: local (default); slurm: the nodes of a cluster")
      ->transform(gateway::process::one_of({"local", "slurm"}));
  command->add_flag("--cancel", options.cancel, "Only cancel its jobs in Slurm");
  command->add_flag("--retry-failed", options.retry_failed, "Repeat the runs that failed");
  command->add_flag("--status", options.status, "Only show its progress");
}

/// What `run` is asked.
struct RunAsked {
  RunOptions options;
  std::string seed;
};

int act(RunAsked& asked) {
  RunOptions& options = asked.options;
  if (!asked.seed.empty()) options.overrides.push_back("seed=" + asked.seed);
  return commands::with_file_of(
      "scenario", {options.scenario, {"scenarios"}, options.overrides}, [&] {
        return options.replications ? campaign::run_replications(options) : run::run(options);
      });
}

}  // namespace

Subcommand add_run(CLI::App& app) {
  const auto held = std::make_shared<RunAsked>();
  RunOptions& options = held->options;
  CLI::App* run = app.add_subcommand("run", "Run a scenario");
  run->add_option("SCENARIO", options.scenario, "Scenario file")->required();
  run->add_option("--seed", held->seed, "Seed, instead of the scenario's")
      ->transform(whole_number(0, kMostSeed));
  run->add_option("--until", options.until, "End at this simulated time: 90 or 1.5 min")
      ->transform(seconds(0));
  add_controllers(*run, options.controllers, "");
  run->add_option(
         "--max-speed", options.max_speed,
         "At most this many simulated seconds per second; changes nothing else; default: as "
         "fast as possible, with --view 1")
      ->transform(plain_number(kLeastSpeed, kMostSpeed));
  CLI::Option* pace = run->add_option("--pace", options.pace,
                                      "lockstep: wait for controllers, and hold programs; "
                                      "realtime[:F]: follow the wall clock, F times as fast, and "
                                      "never wait; default: lockstep");
  CLI::Option* repeat =
      run->add_option(
             "--repeat", options.repeat,
             "Folder of a run in real time, or with input from outside: repeat it from its record, "
             "without a clock")
          ->excludes(pace);
  add_surroundings(run, options);
  CLI::Option* view = add_live_view(run, options.view);
  CLI::Option* replications =
      run->add_option("--replications", options.replications,
                      "Number of runs, with seeds from the scenario's upwards; runs that have "
                      "ended are kept")
          ->transform(whole_number(1, kMostReplications))
          ->excludes(pace)
          ->excludes(repeat)
          ->excludes(view);
  run->add_option("--jobs", options.jobs, "Replications at a time; default: 1")
      ->transform(whole_number(1, kMostJobs))
      ->needs(replications);
  return {run, [held] { return act(*held); }};
}

Subcommand add_campaign(CLI::App& app) {
  CLI::App* add = app.add_subcommand(
      "campaign",
      "Run a scenario many times, over the values of its keys; continues where it ended");
  const auto held = std::make_shared<campaign::CampaignOptions>();
  add_campaign_options(add, *held, "campaign");
  return {add, [held] {
            return commands::with_file_of("campaign", {held->file, {"campaigns"}, held->overrides},
                                          [&] { return campaign::run_campaign(*held); });
          }};
}

Subcommand add_fleet(CLI::App& app) {
  CLI::App* add = app.add_subcommand("fleet",
                                     "Find with how many robots the topics of a fleet still "
                                     "arrive, and what breaks first; continues where it ended");
  const auto held = std::make_shared<campaign::CampaignOptions>();
  add_campaign_options(add, *held, "fleet");
  return {add, [held] {
            return commands::with_file_of("fleet", {held->file, {"fleets"}, held->overrides},
                                          [&] { return fleet::run_fleet(*held); });
          }};
}

}  // namespace baraka::main
