#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <system_error>

#include "gateway/app/exit_status.h"
#include "gateway/app/export_command.h"
#include "gateway/app/new_controller.h"
#include "gateway/app/replications.h"
#include "gateway/app/report_command.h"
#include "gateway/app/run_command.h"
#include "gateway/app/topic_command.h"
#include "gateway/limits.h"
#include "hal/config/errors.h"
#include "hal/dds/domains.h"

namespace {

using gateway::app::ControllersFrom;
using gateway::app::RunOptions;

void add_run(CLI::App& app, RunOptions& options, std::string& seed) {
  CLI::App* run = app.add_subcommand("run", "Run a scenario");
  run->add_option("SCENARIO", options.scenario, "Scenario file")->required();
  run->add_option("--seed", seed, "Seed, instead of the scenario's");
  run->add_option("--until", options.until, "End at this simulated time [s]")
      ->check(CLI::NonNegativeNumber);
  const std::map<std::string, ControllersFrom> from{{"spawn", ControllersFrom::kSpawn},
                                                    {"external", ControllersFrom::kExternal},
                                                    {"in-process", ControllersFrom::kInProcess}};
  run->add_option("--controllers", options.controllers,
                  "spawn: start them; external: wait for them; in-process: load them")
      ->transform(CLI::CheckedTransformer(from));
  run->add_option("--max-speed", options.max_speed,
                  "At most this many simulated seconds per second; changes nothing else")
      ->check(CLI::PositiveNumber);
  CLI::Option* pace = run->add_option("--pace", options.pace,
                                      "lockstep: wait for controllers; realtime[:F]: follow the "
                                      "wall clock, F times as fast, and wait for nobody");
  CLI::Option* repeat =
      run->add_option("--repeat", options.repeat,
                      "Folder of a run in real time: repeat it from its record, without a clock")
          ->excludes(pace);
  run->add_option("--domain", options.domain, "DDS domain; default: the first free one")
      ->check(CLI::Range(0, 232));
  run->add_option("--inspect-domain", options.inspect_domain,
                  "DDS domain to show the run in; default: the run's")
      ->check(CLI::Range(0, 232));
  run->add_flag("!--no-inspect", options.inspect, "Do not show the run to DDS tools");
  run->add_option("--out", options.out, "Folder for the results; default: results/<name>");
  run->add_flag("--overwrite", options.overwrite,
                "Remove an earlier result there; default: keep it as <name>.1, .2, ...");
  run->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  CLI::Option* replications =
      run->add_option("--replications", options.replications,
                      "Run it so many times, with seeds from the scenario's upwards; those that "
                      "have ended are kept")
          ->check(CLI::Range(1, 1'000'000))
          ->excludes(pace)
          ->excludes(repeat);
  run->add_option("--jobs", options.jobs, "Replications at a time; default: 1")
      ->check(CLI::Range(1, 1000))
      ->needs(replications);
}

void add_new_controller(CLI::App& app, gateway::app::NewControllerOptions& options) {
  CLI::App* add =
      app.add_subcommand("new-controller", "Write a project for a controller of your own");
  add->add_option("NAME", options.name, "Of the program: a-z, 0-9 and _")->required();
  CLI::Option* mote = add->add_flag("--mote", options.for_mote, "It drives motes");
  add->add_flag("--robot")->description("It drives robots (the default)")->excludes(mote);
  add->add_option("--to", options.to, "Folder for the project's folder; default: this one");
}

void add_export(CLI::App& app, gateway::app::ExportOptions& options) {
  CLI::App* add = app.add_subcommand("export", "Tables of a result as CSV");
  add->add_option("DIR", options.folder, "Folder of a result");
  add->add_option("TABLE", options.table, "Table to print; default: list them");
  add->add_option("-o", options.file, "Write to this file");
  add->add_flag("--describe", options.describe, "What is in a result: every table and column");
}

struct TopicCommand {
  CLI::App* app;
  int (*act)(const gateway::app::TopicOptions&);
};

/// @return the commands of `baraka topic`.
std::vector<TopicCommand> add_topic(CLI::App& app, gateway::app::TopicOptions& options) {
  CLI::App* topic = app.add_subcommand("topic", "Look at the topics of a run or a robot");
  topic->require_subcommand(1);
  std::vector<TopicCommand> commands{
      {topic->add_subcommand("list", "All topics"), gateway::app::list_topics},
      {topic->add_subcommand("info", "Type and endpoints"), gateway::app::topic_info},
      {topic->add_subcommand("echo", "Samples"), gateway::app::echo_topic},
      {topic->add_subcommand("hz", "How often samples come"), gateway::app::topic_rate},
      {topic->add_subcommand("bw", "How many bytes come"), gateway::app::topic_bandwidth}};
  for (const TopicCommand& command : commands) {
    command.app
        ->add_option("--domain", options.domain, "DDS domain; default: BARAKA_DOMAIN, else 1")
        ->check(CLI::Range(0, 232));
    if (command.act == gateway::app::list_topics) continue;
    command.app->add_option("TOPIC", options.topic, "As listed, or as in ROS 2: /clock")
        ->required();
    command.app
        ->add_option("--timeout", options.timeout, "Wait so long for the topic and a sample [s]")
        ->check(CLI::PositiveNumber);
    if (command.act == gateway::app::topic_info) continue;
    command.app->add_option("--count", options.count, "End after so many samples")
        ->check(CLI::PositiveNumber);
  }
  return commands;
}

/// @return exit status. @throws std::exception
int command(int argc, char** argv) {
  CLI::App app("BARAKA: robots and motes that talk IEEE 802.11, with controllers over DDS");
  app.require_subcommand(1);
  RunOptions run_options;
  std::string seed;
  add_run(app, run_options, seed);
  std::string checked;
  std::vector<std::string> check_overrides;
  CLI::App* check = app.add_subcommand("check", "Find every mistake in a scenario");
  check->add_option("SCENARIO", checked, "Scenario file")->required();
  check->add_option("--set", check_overrides, "KEY=VALUE")->allow_extra_args(false);
  std::vector<std::string> folders;
  std::string page;
  CLI::App* report = app.add_subcommand("report", "Tables and figures of one or many results");
  report->add_option("DIR", folders, "Folders of results")->required();
  report->add_option("-o", page, "Write a page with the figures to this file, print no tables");
  gateway::app::ExportOptions export_options;
  add_export(app, export_options);
  gateway::app::TopicOptions topic_options;
  const std::vector<TopicCommand> topic_commands = add_topic(app, topic_options);
  gateway::app::NewControllerOptions controller;
  add_new_controller(app, controller);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int status = app.exit(e);
    return status == 0 ? gateway::app::kDone : gateway::app::kUsage;
  }
  for (const TopicCommand& topic : topic_commands) {
    if (*topic.app) return topic.act(topic_options);
  }
  if (!seed.empty()) run_options.overrides.push_back("seed=" + seed);
  if (*check) return gateway::app::check(checked, check_overrides);
  if (app.got_subcommand("export")) return gateway::app::export_results(export_options);
  if (*report) return gateway::app::report(folders, page);
  if (app.got_subcommand("new-controller")) return gateway::app::new_controller(controller);
  return run_options.replications ? gateway::app::run_replications(run_options)
                                  : gateway::app::run(run_options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return command(argc, argv);
  } catch (const hal::config::ConfigErrors& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return gateway::app::kUsage;
  } catch (const gateway::app::UsageError& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return gateway::app::kUsage;
  } catch (const hal::dds::NoSuchDomain& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return gateway::app::kUsage;
  } catch (const std::system_error& e) {
    const bool is_thread_missing = e.code() == std::errc::resource_unavailable_try_again;
    const std::string why = is_thread_missing ? gateway::limit_met(e.code().value()) : e.what();
    std::fprintf(stderr, "error: %s\n", why.c_str());
    return gateway::app::kRunFailed;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return gateway::app::kRunFailed;
  }
}
