#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "baraka/commands/check_command.h"
#include "baraka/commands/describe_command.h"
#include "baraka/commands/file_kinds.h"
#include "baraka/commands/list_command.h"
#include "baraka/commands/new_controller.h"
#include "baraka/commands/observables_page.h"
#include "baraka/commands/robot_from.h"
#include "baraka/main/commands.h"
#include "baraka/main/controllers_option.h"
#include "gateway/process/command_line.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/status_of_command.h"

namespace baraka::main {
namespace {

struct DescribeOptions {
  std::string what;
  bool markdown = false;

  int act() const {
    if (!markdown) return commands::describe(what);
    if (!what.empty() && what != "observables") {
      throw gateway::process::UsageError(
          "describe: --markdown is for all keys, or for observables");
    }
    std::fputs((what.empty() ? commands::keys_page() : commands::observables_page()).c_str(),
               stdout);
    return gateway::process::kDone;
  }
};

}  // namespace

Subcommand add_check(CLI::App& app) {
  const auto held = std::make_shared<commands::CheckOptions>();
  commands::CheckOptions& options = *held;
  CLI::App* check = app.add_subcommand(
      "check",
      "Find every mistake in scenario, campaign, fleet, hardware, robot, mote or radio files");
  check->add_option("FILE", options.files, "Files")->required();
  check->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  std::vector<std::string> kinds;
  for (const auto& kind : commands::file_kinds()) kinds.push_back(kind.name);
  add_controllers(*check, options.mode.controllers, "How a scenario is to be run; ");
  check->add_option("--kind", options.kind, "Kind of the files; default: recognised by their keys")
      ->transform(gateway::process::one_of(kinds));
  return {check, [held] { return commands::check(*held); }};
}

Subcommand add_describe(CLI::App& app) {
  const auto held = std::make_shared<DescribeOptions>();
  DescribeOptions& options = *held;
  CLI::App* describe =
      app.add_subcommand("describe", "Explain keys of files and parameters of controllers");
  describe->add_option("WHAT", options.what, "A kind of file, a key, a controller, or observables");
  describe->add_flag("--markdown", options.markdown,
                     "All keys of all files as the page docs/keys.md; of observables "
                     "docs/observables.md");
  return {describe, [held] { return held->act(); }};
}

Subcommand add_list(CLI::App& app) {
  const auto held = std::make_shared<std::string>();
  CLI::App* list = app.add_subcommand(
      "list", "List available scenarios, robots, radios, controllers …, one per line");
  list->add_option("KIND", *held, "Default: all")
      ->transform(gateway::process::one_of(commands::listed_kinds()));
  return {list, [held] { return commands::list(*held); }};
}

Subcommand add_robot(CLI::App& app) {
  const auto held = std::make_shared<commands::RobotFromOptions>();
  commands::RobotFromOptions& options = *held;
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
  return {from, [held] { return commands::robot_from(*held); }};
}

Subcommand add_new_controller(CLI::App& app) {
  const auto held = std::make_shared<commands::NewControllerOptions>();
  commands::NewControllerOptions& options = *held;
  CLI::App* add =
      app.add_subcommand("new-controller", "Write a project for a controller of your own");
  add->add_option("NAME", options.name, "Name of the program: a-z, 0-9 and _")->required();
  CLI::Option* mote = add->add_flag("--mote", options.for_mote, "It drives motes");
  add->add_flag("--robot")->description("It drives robots (the default)")->excludes(mote);
  CLI::Option* python = add->add_flag("--python", options.in_python, "In Python, not in C++");
  add->add_option(
         "--from", options.from,
         "Begin with a working example: two_turtlebots, robots that search and communicate")
      ->transform(gateway::process::one_of(commands::new_controller_models()))
      ->excludes(mote)
      ->excludes(python);
  add->add_option("--to", options.to, "Folder for the project's folder; default: this one");
  return {add, [held] { return commands::new_controller(*held); }};
}

}  // namespace baraka::main
