#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "baraka/commands/capsule_command.h"
#include "baraka/commands/diff_command.h"
#include "baraka/commands/export_command.h"
#include "baraka/commands/report_command.h"
#include "baraka/commands/view_command.h"
#include "baraka/commands/wrong_kind.h"
#include "baraka/main/commands.h"
#include "gateway/process/command_line.h"

namespace baraka::main {
namespace {

using gateway::process::whole_number;

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

}  // namespace

Subcommand add_report(CLI::App& app) {
  const auto held = std::make_shared<commands::ReportOptions>();
  commands::ReportOptions& options = *held;
  using sim::scenario::IntervalKind;
  using sim::scenario::PlotKind;
  CLI::App* add = app.add_subcommand("report", "Tables and figures of results or of a campaign");
  add->add_option("DIR", options.folders, "Folders of results, or of a campaign")->required();
  add->add_option("-o", options.file,
                  "Write to this file, print no tables: a page with all figures (.html), one "
                  "figure (.svg) or its data (.csv, .json)");
  add->add_option(
      "--figure", options.figure,
      "A quantity of `baraka describe observables`, or one of the scenario's report; without "
      "-o also a pattern of several, with * and ?");
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
  return {add, [held] { return commands::report(*held); }};
}

Subcommand add_view(CLI::App& app) {
  const auto held = std::make_shared<commands::ViewOptions>();
  commands::ViewOptions& options = *held;
  CLI::App* add = app.add_subcommand(
      "view", "See results, or a scenario, in a browser: world, network and time");
  add->add_option("DIR|SCENARIO", options.what,
                  "Folders of results, shown side by side; or one scenario file")
      ->required();
  add->add_option("--port", options.port, "Port of 127.0.0.1; default: a free one")
      ->transform(whole_number(1, kMostPort));
  add->add_flag_callback(
      "--no-open", [&options] { options.open = false; }, "Do not open a browser");
  CLI::Option* to_file = add->add_option("--export", options.file,
                                         "Write a self-contained page to this file, do not serve");
  add->add_option("--most-mb", options.most_mb,
                  "Most megabytes of data in it; the finest details are left out. Default: 64")
      ->transform(whole_number(1, kMostPageSize))
      ->needs(to_file);
  return {add, [held] {
            return commands::with_file_of("scenario", {held->what.front(), {"scenarios"}},
                                          [&] { return commands::show_view(*held); });
          }};
}

Subcommand add_export(CLI::App& app) {
  const auto held = std::make_shared<commands::ExportOptions>();
  commands::ExportOptions& options = *held;
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
  return {add, [held] { return commands::export_results(*held); }};
}

Subcommand add_capsule(CLI::App& app) {
  const auto held = std::make_shared<commands::CapsuleOptions>();
  commands::CapsuleOptions& options = *held;
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
  return {capsule, [held] { return commands::capsule(*held); }};
}

Subcommand add_diff(CLI::App& app) {
  const auto held = std::make_shared<commands::DiffOptions>();
  commands::DiffOptions& options = *held;
  CLI::App* diff = app.add_subcommand(
      "diff", "First difference between two runs; status 0: none, 1: there is one, 2: error");
  diff->add_option("DIR", options.folder, "Folder of the result of a run")->required();
  diff->add_option("OTHER", options.other, "Folder of the result of the other run")->required();
  return {diff, [held] { return commands::diff(*held); }};
}

}  // namespace baraka::main
