#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include "baraka/campaign/campaign_command.h"
#include "baraka/commands/capsule_command.h"
#include "baraka/commands/check_command.h"
#include "baraka/commands/describe_command.h"
#include "baraka/commands/diff_command.h"
#include "baraka/commands/exec_command.h"
#include "baraka/commands/export_command.h"
#include "baraka/commands/file_kinds.h"
#include "baraka/commands/list_command.h"
#include "baraka/commands/new_controller.h"
#include "baraka/commands/observables_page.h"
#include "baraka/commands/report_command.h"
#include "baraka/commands/robot_from.h"
#include "baraka/commands/topic_command.h"
#include "baraka/commands/topic_domain.h"
#include "baraka/commands/topic_from.h"
#include "baraka/commands/view_command.h"
#include "baraka/commands/wrong_kind.h"
#include "baraka/fleet/fleet_command.h"
#include "baraka/main/coverage_options.h"
#include "baraka/main/run_options.h"
#include "baraka/run/run_command.h"
#include "gateway/process/command_line.h"
#include "gateway/process/domains.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/manual.h"
#include "gateway/process/standard_output.h"
#include "gateway/process/status_of_command.h"

namespace {

using gateway::process::seconds;
using gateway::process::whole_number;

constexpr std::int64_t kMostSamples = 1'000'000'000;
constexpr double kLeastTimeout = 1e-3;  // s
constexpr std::int64_t kMostPort = 65535, kMostPageSize = 2000;

/// Adds an option that takes one of several words, each standing for a value.
template <class Value>
void add_choice(CLI::App* command, const std::string& name, const std::string& about,
                std::optional<Value>& chosen, const std::map<std::string, Value>& values) {
  std::vector<std::string> words;
  words.reserve(values.size());
  for (const auto& [word, value] : values) words.push_back(word);
  command
      ->add_option_function<std::string>(
          name, [&chosen, values](const std::string& word) { chosen = values.at(word); }, about)
      ->transform(gateway::process::one_of(words));
}

void add_new_controller(CLI::App& app, baraka::commands::NewControllerOptions& options) {
  CLI::App* add =
      app.add_subcommand("new-controller", "Write a project for a controller of your own");
  add->add_option("NAME", options.name, "Name of the program: a-z, 0-9 and _")->required();
  CLI::Option* mote = add->add_flag("--mote", options.for_mote, "It drives motes");
  add->add_flag("--robot")->description("It drives robots (the default)")->excludes(mote);
  CLI::Option* python = add->add_flag("--python", options.in_python, "In Python, not in C++");
  add->add_option(
         "--from", options.from,
         "Begin with a working example: two_turtlebots, robots that search and communicate")
      ->transform(gateway::process::one_of(baraka::commands::new_controller_models()))
      ->excludes(mote)
      ->excludes(python);
  add->add_option("--to", options.to, "Folder for the project's folder; default: this one");
}

void add_check(CLI::App& app, baraka::commands::CheckOptions& options) {
  CLI::App* check = app.add_subcommand(
      "check",
      "Find every mistake in scenario, campaign, fleet, hardware, robot, mote or radio files");
  check->add_option("FILE", options.files, "Files")->required();
  check->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  std::vector<std::string> kinds;
  for (const auto& kind : baraka::commands::file_kinds()) kinds.push_back(kind.name);
  baraka::main::add_controllers(*check, options.mode.controllers, "How a scenario is to be run; ");
  check->add_option("--kind", options.kind, "Kind of the files; default: recognised by their keys")
      ->transform(gateway::process::one_of(kinds));
}

struct DescribeOptions {
  std::string what;
  bool markdown = false;

  int act() const {
    if (!markdown) return baraka::commands::describe(what);
    if (!what.empty() && what != "observables") {
      throw gateway::process::UsageError(
          "describe: --markdown is for all keys, or for observables");
    }
    std::fputs((what.empty() ? baraka::commands::keys_page() : baraka::commands::observables_page())
                   .c_str(),
               stdout);
    return gateway::process::kDone;
  }
};

void add_describe(CLI::App& app, DescribeOptions& options) {
  CLI::App* describe =
      app.add_subcommand("describe", "Explain keys of files and parameters of controllers");
  describe->add_option("WHAT", options.what, "A kind of file, a key, a controller, or observables");
  describe->add_flag("--markdown", options.markdown,
                     "All keys of all files as the page docs/keys.md; of observables "
                     "docs/observables.md");
}

void add_list(CLI::App& app, std::string& kind) {
  app.add_subcommand("list",
                     "List available scenarios, robots, radios, controllers …, one per line")
      ->add_option("KIND", kind, "Default: all")
      ->transform(gateway::process::one_of(baraka::commands::listed_kinds()));
}

void add_report(CLI::App& app, baraka::commands::ReportOptions& options) {
  using sim::scenario::IntervalKind;
  using sim::scenario::PlotKind;
  CLI::App* add = app.add_subcommand("report", "Tables and figures of results or of a campaign");
  add->add_option("DIR", options.folders, "Folders of results, or of a campaign")->required();
  add->add_option("-o", options.file,
                  "Write to this file, print no tables: a page with all figures (.html), one "
                  "figure (.svg) or its data (.csv, .json)");
  add->add_option("--figure", options.figure,
                  "One quantity of `baraka describe observables`, or one of the scenario's report");
  add->add_option("--versus", options.versus, "Key of the setting along the axis");
  add->add_option("--by", options.by, "Key of the setting with a curve for each value");
  add->add_option("--agent", options.agent, "Agent, for a quantity of agents");
  add_choice(add, "--as", "What the figure shows", options.as,
             {{"points", PlotKind::kPoints},
              {"table", PlotKind::kTable},
              {"histogram", PlotKind::kHistogram},
              {"time", PlotKind::kTime}});
  add_choice(add, "--interval", "Interval of means over runs", options.interval,
             {{"student", IntervalKind::kStudent}, {"bootstrap", IntervalKind::kBootstrap}});
  add->add_option("--scenario", options.scenario,
                  "Use `report:` of this scenario file as it is now, not as the runs had it");
  add->add_option("--resamples", options.resamples,
                  "Write the resamples of bootstrap intervals to this file");
}

void add_export(CLI::App& app, baraka::commands::ExportOptions& options) {
  CLI::App* add =
      app.add_subcommand("export", "Tables of a result as CSV, or all of it for other viewers");
  add->add_option("DIR", options.folder, "Folder of a result or of a campaign");
  add->add_option("TABLE", options.table, "Table to print; default: list them");
  add->add_option("-o", options.file, "Write to this file; with --format csv into this folder");
  add->add_option("--format", options.format,
                  "csv: every table; mcap: messages of ROS 2 for Foxglove, PlotJuggler and RViz; "
                  "links: received powers, which the law `measured` of `propagation` plays")
      ->transform(gateway::process::one_of({"csv", "mcap", "links"}));
  add->add_flag("--describe", options.describe,
                "Describe the tables and columns of a result, or of this campaign");
}

void add_capsule(CLI::App& app, baraka::commands::CapsuleOptions& options) {
  CLI::App* capsule = app.add_subcommand(
      "capsule", "Pack a result or a campaign so that others can play it again (.tar.zst)");
  capsule->add_option("DIR", options.folder, "Folder of a result or of a campaign")->required();
  capsule->add_option("-o", options.file, "File to write")->required();
  capsule->add_option("--add", options.added, "Further files, such as sources of controllers")
      ->check(CLI::ExistingFile)
      ->allow_extra_args(false);
  capsule
      ->add_option("--most-rows", options.most_rows,
                   "Leave out the rows of tables that have more; default: 10000")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
}

void add_diff(CLI::App& app, baraka::commands::DiffOptions& options) {
  CLI::App* diff = app.add_subcommand(
      "diff", "First difference between two runs; status 0: none, 1: there is one, 2: error");
  diff->add_option("DIR", options.folder, "Folder of the result of a run")->required();
  diff->add_option("OTHER", options.other, "Folder of the result of the other run")->required();
}

void add_exec(CLI::App& app, baraka::commands::ExecOptions& options) {
  CLI::App* exec = app.add_subcommand(
      "exec", "Run a command inside an agent of a run under way: baraka exec r0 -- ping r1");
  exec->add_option("AGENT", options.agent, "An agent with a network")->required();
  exec->add_option("--run", options.run, "Folder of its results; default: the only run under way");
  exec->add_option("COMMAND", options.command, "After --; default: a shell");
}

void add_view(CLI::App& app, baraka::commands::ViewOptions& options) {
  CLI::App* add = app.add_subcommand(
      "view", "See results, or a scenario, in a browser: world, network and time");
  add->add_option("DIR|SCENARIO", options.what,
                  "Folders of results, shown side by side; or one scenario file")
      ->required();
  add->add_option("--port", options.port, "Port of 127.0.0.1; default: a free one")
      ->transform(whole_number(1, kMostPort));
  add->add_flag_callback(
      "--no-open", [&] { options.open = false; }, "Do not open a browser");
  CLI::Option* to_file = add->add_option("--export", options.file,
                                         "Write a self-contained page to this file, do not serve");
  add->add_option("--most-mb", options.most_mb,
                  "Most megabytes of data in it; the finest details are left out. Default: 64")
      ->transform(whole_number(1, kMostPageSize))
      ->needs(to_file);
}

struct TopicCommand {
  CLI::App* app;
  int (*act)(const baraka::commands::TopicOptions&);
};

/// @return the commands of `baraka topic`.
std::vector<TopicCommand> add_topic(CLI::App& app, baraka::commands::TopicOptions& options) {
  CLI::App* topic =
      app.add_subcommand("topic", "Inspect the topics of a run, a robot or a recording");
  topic->require_subcommand(1);
  std::vector<TopicCommand> commands{
      {topic->add_subcommand("list", "All topics"), baraka::commands::list_topics},
      {topic->add_subcommand("info", "Type and endpoints"), baraka::commands::topic_info},
      {topic->add_subcommand("echo", "Samples"), baraka::commands::echo_topic},
      {topic->add_subcommand("hz", "Rate of samples"), baraka::commands::topic_rate},
      {topic->add_subcommand("bw", "Bandwidth of samples"), baraka::commands::topic_bandwidth},
      {topic->add_subcommand("from", "What a recording holds, as `topics:` of a scenario"),
       baraka::commands::topics_from}};
  for (const TopicCommand& command : commands) {
    if (command.act == baraka::commands::topics_from) {
      command.app
          ->add_option("FILE", options.file,
                       "MCAP, rosbag2 (its folder, metadata.yaml or .db3), pcap or pcapng")
          ->required();
      continue;
    }
    command.app
        ->add_option("--domain", options.domain,
                     "DDS domain; default: BARAKA_DOMAIN, else the one in which a run or daemon "
                     "publishes its topics, else ROS_DOMAIN_ID, else 1")
        ->transform(whole_number(0, gateway::process::kLastDomain));
    if (command.act == baraka::commands::list_topics) continue;
    command.app->add_option("TOPIC", options.topic, "As listed, or as in ROS 2: /clock")
        ->required();
    command.app->add_option("--timeout", options.timeout, "Longest wait for the topic and a sample")
        ->transform(seconds(kLeastTimeout));
    if (command.act == baraka::commands::topic_info) continue;
    command.app->add_option("--count", options.count, "End after this number of samples")
        ->transform(whole_number(1, kMostSamples));
  }
  return commands;
}

/// @return `baraka robot from`.
CLI::App* add_robot(CLI::App& app, baraka::commands::RobotFromOptions& options) {
  CLI::App* robot = app.add_subcommand("robot", "Robots of others");
  robot->require_subcommand(1);
  CLI::App* from =
      robot->add_subcommand("from", "A robot in URDF or SDF, as a robot file; see docs/urdf.md");
  from->add_option("FILE", options.file, "URDF, with or without xacro, or SDF")->required();
  from->add_option("--drive", options.drive,
                   "Names of the wheels' joints: '{left: A, right: B, casters: LINK}'");
  from->add_option("--model", options.model, "Which model of an SDF file; default: the only one");
  from->add_option("--robot-path", options.folders,
                   "Where package:// and model:// are searched for, before ROS_PACKAGE_PATH, "
                   "AMENT_PREFIX_PATH and GZ_SIM_RESOURCE_PATH")
      ->allow_extra_args(false);
  return from;
}

/// The options of all commands.
struct Asked {
  baraka::run::RunOptions run;
  std::string seed;
  std::string listed;
  baraka::campaign::CampaignOptions campaign, fleet;
  baraka::commands::CheckOptions check;
  baraka::commands::CoverageCommand coverage;
  baraka::commands::SurveyCommand survey;
  DescribeOptions describe;
  baraka::commands::ReportOptions report;
  baraka::commands::ViewOptions view;
  baraka::commands::ExportOptions export_;
  baraka::commands::CapsuleOptions capsule;
  baraka::commands::DiffOptions diff;
  baraka::commands::ExecOptions exec;
  baraka::commands::TopicOptions topic;
  baraka::commands::RobotFromOptions robot;
  baraka::commands::NewControllerOptions controller;
};

/// What is done with results: the exit status; nothing was asked: none. @throws std::exception
std::optional<int> act_on_results(const CLI::App& app, const Asked& asked) {
  if (app.got_subcommand("capsule")) return baraka::commands::capsule(asked.capsule);
  if (app.got_subcommand("diff")) return baraka::commands::diff(asked.diff);
  if (app.got_subcommand("export")) return baraka::commands::export_results(asked.export_);
  if (app.got_subcommand("report")) return baraka::commands::report(asked.report);
  return std::nullopt;
}

/// @return exit status. @throws std::exception
int act(const CLI::App& app, Asked& asked) {
  if (!asked.seed.empty()) asked.run.overrides.push_back("seed=" + asked.seed);
  if (app.got_subcommand("campaign")) {
    return baraka::commands::with_file_of(
        "campaign", {asked.campaign.file, {"campaigns"}, asked.campaign.overrides},
        [&] { return baraka::campaign::run_campaign(asked.campaign); });
  }
  if (app.got_subcommand("fleet")) {
    return baraka::commands::with_file_of("fleet",
                                          {asked.fleet.file, {"fleets"}, asked.fleet.overrides},
                                          [&] { return baraka::fleet::run_fleet(asked.fleet); });
  }
  if (app.got_subcommand("check")) return baraka::commands::check(asked.check);
  if (const auto done = baraka::main::act(app, asked.coverage, asked.survey)) return *done;
  if (const auto done = act_on_results(app, asked)) return *done;
  if (app.got_subcommand("describe")) return asked.describe.act();
  if (app.got_subcommand("exec")) baraka::commands::exec_inside(asked.exec);
  if (app.got_subcommand("list")) return baraka::commands::list(asked.listed);
  if (app.got_subcommand("view")) {
    return baraka::commands::with_file_of("scenario", {asked.view.what.front(), {"scenarios"}},
                                          [&] { return baraka::commands::show_view(asked.view); });
  }
  if (app.got_subcommand("new-controller"))
    return baraka::commands::new_controller(asked.controller);
  return baraka::commands::with_file_of(
      "scenario", {asked.run.scenario, {"scenarios"}, asked.run.overrides}, [&] {
        return asked.run.replications ? baraka::campaign::run_replications(asked.run)
                                      : baraka::run::run(asked.run);
      });
}

/// @return exit status. @throws std::exception
int command(int argc, char** argv) {
  CLI::App app(
      "BARAKA: robots and motes that communicate by IEEE 802.11, with controllers over DDS");
  app.require_subcommand(1);
  Asked asked;
  baraka::main::add_run(app, asked.run, asked.seed);
  baraka::main::add_campaign(app, asked.campaign);
  baraka::main::add_fleet(app, asked.fleet);
  add_check(app, asked.check);
  add_describe(app, asked.describe);
  add_list(app, asked.listed);
  add_report(app, asked.report);
  add_view(app, asked.view);
  baraka::main::add_coverage(app, asked.coverage);
  baraka::main::add_survey(app, asked.survey);
  add_export(app, asked.export_);
  add_capsule(app, asked.capsule);
  add_diff(app, asked.diff);
  add_exec(app, asked.exec);
  const CLI::App* const robot_from = add_robot(app, asked.robot);
  const std::vector<TopicCommand> topic_commands = add_topic(app, asked.topic);
  add_new_controller(app, asked.controller);
  gateway::process::complete(app, "baraka");
  gateway::process::add_manual(app, "baraka");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return gateway::process::end_of_parsing(app, e);
  }
  if (*robot_from) return baraka::commands::robot_from(asked.robot);
  for (const TopicCommand& topic : topic_commands) {
    if (!*topic.app) continue;
    if (topic.act != baraka::commands::topics_from)
      asked.topic.domain = baraka::commands::topic_domain(asked.topic.domain);
    return topic.act(asked.topic);
  }
  return act(app, asked);
}

}  // namespace

int main(int argc, char** argv) {
  return gateway::process::with_output_written(
      gateway::process::status_of_command([&] { return command(argc, argv); }));
}
