#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include "gateway/campaign/campaign_command.h"
#include "gateway/commands/check_command.h"
#include "gateway/commands/describe_command.h"
#include "gateway/commands/exec_command.h"
#include "gateway/commands/export_command.h"
#include "gateway/commands/file_kinds.h"
#include "gateway/commands/list_command.h"
#include "gateway/commands/new_controller.h"
#include "gateway/commands/observables_page.h"
#include "gateway/commands/report_command.h"
#include "gateway/commands/topic_command.h"
#include "gateway/commands/topic_domain.h"
#include "gateway/commands/view_command.h"
#include "gateway/commands/wrong_kind.h"
#include "gateway/exit_status.h"
#include "gateway/run/domain_range.h"
#include "gateway/run/run_command.h"
#include "gateway/status_of_command.h"
#include "hal/dds/domains.h"
#include "hal/runtime/command_line.h"
#include "hal/runtime/standard_output.h"

namespace {

using gateway::ControllersFrom;
using gateway::RunOptions;
using hal::runtime::plain_number;
using hal::runtime::seconds;
using hal::runtime::whole_number;

constexpr std::int64_t kMostSeed = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostReplications = 1'000'000, kMostJobs = 1000,
                       kMostSamples = 1'000'000'000;
constexpr double kLeastSpeed = 1e-6, kMostSpeed = 1e9;
constexpr double kLeastTimeout = 1e-3;  // s
constexpr std::int64_t kMostPort = 65535, kMostPageSize = 2000;

/// For an option that takes a DDS domain, "7", or a range of them, "7-9".
CLI::Validator domains() {
  return {[](std::string& text) {
            return gateway::is_domain_range(text)
                       ? std::string{}
                       : fmt::format(
                             "'{}' is no DDS domain from 0 to {}, nor a range of them such as 7-9",
                             text, hal::dds::kLastDomain);
          },
          fmt::format("0 to {}", hal::dds::kLastDomain)};
}

/// An option that takes one of some words, each of which means a value.
template <class Value>
void add_choice(CLI::App* command, const std::string& name, const std::string& about,
                std::optional<Value>& chosen, const std::map<std::string, Value>& values) {
  std::vector<std::string> words;
  words.reserve(values.size());
  for (const auto& [word, value] : values) words.push_back(word);
  command
      ->add_option_function<std::string>(
          name, [&chosen, values](const std::string& word) { chosen = values.at(word); }, about)
      ->transform(hal::runtime::one_of(words));
}

/// Which domains and files it uses.
void add_surroundings(CLI::App* run, RunOptions& options) {
  run->add_option("--domain", options.domain,
                  "DDS domain; default: the first free one. With --jobs the first of as many, or "
                  "FIRST-LAST")
      ->transform(domains());
  run->add_option("--inspect-domain", options.inspect_domain,
                  "DDS domain to show the run in; default: the run's")
      ->transform(whole_number(0, hal::dds::kLastDomain));
  run->add_flag_callback(
      "--no-inspect", [&] { options.inspect = false; }, "Do not show the run to DDS tools");
  run->add_option("--out", options.out, "Folder for the results; default: results/<name>");
  run->add_flag("--overwrite", options.overwrite,
                "Remove an earlier result there; default: keep it as <name>.1, .2, ...");
  run->add_flag("--once", options.once,
                "Keep a finished result of this seed there, and wait for another run that is "
                "writing there");
  run->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  run->add_option("--log", options.log, "Least that run.log tells of; default: info")
      ->transform(hal::runtime::one_of({"debug", "info", "warning", "error"}));
}

/// @return --view.
CLI::Option* add_live_view(CLI::App* run, gateway::LiveViewOptions& view) {
  CLI::Option* shown = run->add_flag("--view", view.shown, "Show the run in a browser");
  run->add_flag("--paused", view.paused, "With --view: begin when the page says so")->needs(shown);
  run->add_option("--view-port", view.port, "With --view: on this port; default: a free one")
      ->transform(whole_number(1, kMostPort))
      ->needs(shown);
  run->add_flag_callback(
         "--no-open", [&] { view.open = false; }, "With --view: do not open a browser")
      ->needs(shown);
  return shown;
}

/// @param of_what  before the words of each choice.
void add_controllers(CLI::App& command, ControllersFrom& controllers, const std::string& of_what) {
  const std::map<std::string, ControllersFrom> from{{"spawn", ControllersFrom::kSpawn},
                                                    {"external", ControllersFrom::kExternal},
                                                    {"in-process", ControllersFrom::kInProcess}};
  command
      .add_option_function<std::string>(
          "--controllers",
          [&controllers, from](const std::string& how) { controllers = from.at(how); },
          of_what + "spawn: start them (default); external: wait for them; in-process: load them")
      ->transform(hal::runtime::one_of({"spawn", "external", "in-process"}));
}

void add_run(CLI::App& app, RunOptions& options, std::string& seed) {
  CLI::App* run = app.add_subcommand("run", "Run a scenario");
  run->add_option("SCENARIO", options.scenario, "Scenario file")->required();
  run->add_option("--seed", seed, "Seed, instead of the scenario's")
      ->transform(whole_number(0, kMostSeed));
  run->add_option("--until", options.until, "End at this simulated time: 90 or 1.5 min")
      ->transform(seconds(0));
  add_controllers(*run, options.controllers, "");
  run->add_option(
         "--max-speed", options.max_speed,
         "At most this many simulated seconds per second; changes nothing else; default: as "
         "fast as it can, with --view 1")
      ->transform(plain_number(kLeastSpeed, kMostSpeed));
  CLI::Option* pace = run->add_option("--pace", options.pace,
                                      "lockstep: wait for controllers; realtime[:F]: follow the "
                                      "wall clock, F times as fast, and wait for nobody");
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
                      "Run it so many times, with seeds from the scenario's upwards; those that "
                      "have ended are kept")
          ->transform(whole_number(1, kMostReplications))
          ->excludes(pace)
          ->excludes(repeat)
          ->excludes(view);
  run->add_option("--jobs", options.jobs, "Replications at a time; default: 1")
      ->transform(whole_number(1, kMostJobs))
      ->needs(replications);
}

void add_campaign(CLI::App& app, gateway::CampaignOptions& options) {
  CLI::App* campaign = app.add_subcommand(
      "campaign", "Run a scenario many times, over the values of its keys; goes on where it ended");
  campaign->add_option("FILE", options.file, "Campaign file")->required();
  campaign->add_option("--out", options.out, "Folder for the results; default: results/<name>");
  campaign->add_flag("--overwrite", options.overwrite,
                     "Remove an earlier result of a single run there");
  campaign
      ->add_option("--jobs", options.jobs,
                   "Runs at a time; default: as the file says, else one for each processor")
      ->transform(whole_number(1, kMostJobs));
  campaign->add_option("--set", options.overrides, "KEY=VALUE of the campaign file")
      ->allow_extra_args(false);
  campaign
      ->add_option("--engine", options.engine,
                   "What runs them: local (default); slurm: the nodes of a cluster")
      ->transform(hal::runtime::one_of({"local", "slurm"}));
  campaign->add_flag("--cancel", options.cancel, "Only end what Slurm still has of it");
  campaign->add_flag("--retry-failed", options.retry_failed, "Do the runs again that failed");
  campaign->add_flag("--status", options.status, "Only say how far it is");
}

void add_new_controller(CLI::App& app, gateway::NewControllerOptions& options) {
  CLI::App* add =
      app.add_subcommand("new-controller", "Write a project for a controller of your own");
  add->add_option("NAME", options.name, "Of the program: a-z, 0-9 and _")->required();
  CLI::Option* mote = add->add_flag("--mote", options.for_mote, "It drives motes");
  add->add_flag("--robot")->description("It drives robots (the default)")->excludes(mote);
  add->add_option("--from", options.from,
                  "Begin with a model that works: two_turtlebots, robots that search and tell")
      ->transform(hal::runtime::one_of(gateway::new_controller_models()))
      ->excludes(mote);
  add->add_option("--to", options.to, "Folder for the project's folder; default: this one");
}

void add_check(CLI::App& app, gateway::CheckOptions& options) {
  CLI::App* check = app.add_subcommand(
      "check", "Find every mistake in scenario, campaign, hardware, robot, mote or radio files");
  check->add_option("FILE", options.files, "Files")->required();
  check->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  std::vector<std::string> kinds;
  for (const auto& kind : gateway::file_kinds()) kinds.push_back(kind.name);
  add_controllers(*check, options.way.controllers, "How a scenario is to be run; ");
  check->add_option("--kind", options.kind, "Of the files; default: recognised by their keys")
      ->transform(hal::runtime::one_of(kinds));
}

struct DescribeOptions {
  std::string what;
  bool markdown = false;

  int act() const {
    if (!markdown) return gateway::describe(what);
    if (!what.empty() && what != "observables") {
      throw gateway::UsageError("describe: --markdown is for all keys, or for observables");
    }
    std::fputs((what.empty() ? gateway::keys_page() : gateway::observables_page()).c_str(), stdout);
    return gateway::kDone;
  }
};

void add_describe(CLI::App& app, DescribeOptions& options) {
  CLI::App* describe =
      app.add_subcommand("describe", "Say what keys of files and parameters of controllers mean");
  describe->add_option("WHAT", options.what, "A kind of file, a key, a controller, or observables");
  describe->add_flag("--markdown", options.markdown,
                     "All keys of all files as the page docs/keys.md; of observables "
                     "docs/observables.md");
}

void add_list(CLI::App& app, std::string& kind) {
  app.add_subcommand("list", "Scenarios, robots, radios, controllers … that are here, a line each")
      ->add_option("KIND", kind, "Default: all")
      ->transform(hal::runtime::one_of(gateway::listed_kinds()));
}

void add_report(CLI::App& app, gateway::ReportOptions& options) {
  using sim::report::IntervalKind;
  using sim::report::PlotKind;
  CLI::App* add = app.add_subcommand("report", "Tables and figures of results or of a campaign");
  add->add_option("DIR", options.folders, "Folders of results, or of a campaign")->required();
  add->add_option("-o", options.file,
                  "Write to this file, print no tables: a page with all figures (.html), one "
                  "figure (.svg) or the data behind it (.csv)");
  add->add_option("--figure", options.figure,
                  "One quantity of `baraka describe observables`, or one of the scenario's report");
  add->add_option("--versus", options.versus, "Key of the setting along the axis");
  add->add_option("--by", options.by, "Key of the setting that has a curve for each of its values");
  add->add_option("--agent", options.agent, "Whose, if agents have it");
  add_choice(add, "--as", "What the figure shows", options.as,
             {{"points", PlotKind::kPoints},
              {"table", PlotKind::kTable},
              {"histogram", PlotKind::kHistogram},
              {"time", PlotKind::kTime}});
  add_choice(add, "--interval", "Of means over runs", options.interval,
             {{"student", IntervalKind::kStudent}, {"bootstrap", IntervalKind::kBootstrap}});
  add->add_option("--scenario", options.scenario,
                  "Show what `report:` of this scenario file says now, not what the runs had");
  add->add_option("--resamples", options.resamples,
                  "Write the resamples of bootstrap intervals to this file");
}

void add_export(CLI::App& app, gateway::ExportOptions& options) {
  CLI::App* add =
      app.add_subcommand("export", "Tables of a result as CSV, or all of it for other viewers");
  add->add_option("DIR", options.folder, "Folder of a result or of a campaign");
  add->add_option("TABLE", options.table, "Table to print; default: list them");
  add->add_option("-o", options.file, "Write to this file; with --format csv into this folder");
  add->add_option("--format", options.format,
                  "csv: every table; mcap: messages of ROS 2 for Foxglove, PlotJuggler and RViz")
      ->transform(hal::runtime::one_of({"csv", "mcap"}));
  add->add_flag("--describe", options.describe,
                "What is in a result, or in this campaign: every table and column");
}

void add_exec(CLI::App& app, gateway::ExecOptions& options) {
  CLI::App* exec = app.add_subcommand(
      "exec", "Run a command inside an agent of a run under way: baraka exec r0 -- ping r1");
  exec->add_option("AGENT", options.agent, "An agent with a network")->required();
  exec->add_option("--run", options.run, "Folder of its results; default: the only run under way");
  exec->add_option("COMMAND", options.command, "Behind --; default: a shell");
}

void add_view(CLI::App& app, gateway::ViewOptions& options) {
  CLI::App* add = app.add_subcommand(
      "view", "See results, or a scenario, in a browser: world, network and time");
  add->add_option("DIR|SCENARIO", options.what,
                  "Folders of results, shown side by side; or one scenario file")
      ->required();
  add->add_option("--port", options.port, "Port of 127.0.0.1; default: a free one")
      ->transform(whole_number(1, kMostPort));
  add->add_flag_callback(
      "--no-open", [&] { options.open = false; }, "Do not open a browser");
  CLI::Option* to_file = add->add_option(
      "--export", options.file, "Write a page that needs nothing else to this file, do not serve");
  add->add_option("--most-mb", options.most_mb,
                  "So many megabytes of data in it; what is finest is left out. Default: 64")
      ->transform(whole_number(1, kMostPageSize))
      ->needs(to_file);
}

struct TopicCommand {
  CLI::App* app;
  int (*act)(const gateway::TopicOptions&);
};

/// @return the commands of `baraka topic`.
std::vector<TopicCommand> add_topic(CLI::App& app, gateway::TopicOptions& options) {
  CLI::App* topic = app.add_subcommand("topic", "Look at the topics of a run or a robot");
  topic->require_subcommand(1);
  std::vector<TopicCommand> commands{
      {topic->add_subcommand("list", "All topics"), gateway::list_topics},
      {topic->add_subcommand("info", "Type and endpoints"), gateway::topic_info},
      {topic->add_subcommand("echo", "Samples"), gateway::echo_topic},
      {topic->add_subcommand("hz", "How often samples come"), gateway::topic_rate},
      {topic->add_subcommand("bw", "How many bytes come"), gateway::topic_bandwidth}};
  for (const TopicCommand& command : commands) {
    command.app
        ->add_option(
            "--domain", options.domain,
            "DDS domain; default: BARAKA_DOMAIN, else the one in which a run or daemon shows "
            "its topics, else ROS_DOMAIN_ID, else 1")
        ->transform(whole_number(0, hal::dds::kLastDomain));
    if (command.act == gateway::list_topics) continue;
    command.app->add_option("TOPIC", options.topic, "As listed, or as in ROS 2: /clock")
        ->required();
    command.app->add_option("--timeout", options.timeout, "Wait so long for the topic and a sample")
        ->transform(seconds(kLeastTimeout));
    if (command.act == gateway::topic_info) continue;
    command.app->add_option("--count", options.count, "End after so many samples")
        ->transform(whole_number(1, kMostSamples));
  }
  return commands;
}

/// What the commands are asked for.
struct Asked {
  RunOptions run;
  std::string seed;
  std::string listed;
  gateway::CampaignOptions campaign;
  gateway::CheckOptions check;
  DescribeOptions describe;
  gateway::ReportOptions report;
  gateway::ViewOptions view;
  gateway::ExportOptions export_;
  gateway::ExecOptions exec;
  gateway::TopicOptions topic;
  gateway::NewControllerOptions controller;
};

/// @return exit status. @throws std::exception
int act(const CLI::App& app, Asked& asked) {
  if (!asked.seed.empty()) asked.run.overrides.push_back("seed=" + asked.seed);
  if (app.got_subcommand("campaign")) {
    return gateway::with_file_of("campaign",
                                 {asked.campaign.file, {"campaigns"}, asked.campaign.overrides},
                                 [&] { return gateway::run_campaign(asked.campaign); });
  }
  if (app.got_subcommand("check")) return gateway::check(asked.check);
  if (app.got_subcommand("describe")) return asked.describe.act();
  if (app.got_subcommand("exec")) gateway::exec_inside(asked.exec);
  if (app.got_subcommand("export")) return gateway::export_results(asked.export_);
  if (app.got_subcommand("list")) return gateway::list(asked.listed);
  if (app.got_subcommand("report")) return gateway::report(asked.report);
  if (app.got_subcommand("view")) {
    return gateway::with_file_of("scenario", {asked.view.what.front(), {"scenarios"}},
                                 [&] { return gateway::show_view(asked.view); });
  }
  if (app.got_subcommand("new-controller")) return gateway::new_controller(asked.controller);
  return gateway::with_file_of(
      "scenario", {asked.run.scenario, {"scenarios"}, asked.run.overrides}, [&] {
        return asked.run.replications ? gateway::run_replications(asked.run)
                                      : gateway::run(asked.run);
      });
}

/// @return exit status. @throws std::exception
int command(int argc, char** argv) {
  CLI::App app("BARAKA: robots and motes that talk IEEE 802.11, with controllers over DDS");
  app.require_subcommand(1);
  Asked asked;
  add_run(app, asked.run, asked.seed);
  add_campaign(app, asked.campaign);
  add_check(app, asked.check);
  add_describe(app, asked.describe);
  add_list(app, asked.listed);
  add_report(app, asked.report);
  add_view(app, asked.view);
  add_export(app, asked.export_);
  add_exec(app, asked.exec);
  const std::vector<TopicCommand> topic_commands = add_topic(app, asked.topic);
  add_new_controller(app, asked.controller);
  hal::runtime::complete(app, "baraka");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return hal::runtime::end_of_parsing(app, e);
  }
  for (const TopicCommand& topic : topic_commands) {
    if (!*topic.app) continue;
    asked.topic.domain = gateway::topic_domain(asked.topic.domain);
    return topic.act(asked.topic);
  }
  return act(app, asked);
}

}  // namespace

int main(int argc, char** argv) {
  return hal::runtime::with_output_written(
      gateway::status_of_command([&] { return command(argc, argv); }));
}
