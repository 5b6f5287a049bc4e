#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>
#include <vector>

#include "baraka/main/commands.h"
#include "gateway/process/command_line.h"
#include "gateway/process/manual.h"
#include "gateway/process/standard_output.h"
#include "gateway/process/status_of_command.h"

namespace {

using baraka::main::Subcommand;

/// All commands, in the order in which the help lists them.
std::vector<Subcommand> add_commands(CLI::App& app) {
  using namespace baraka::main;
  std::vector<Subcommand> all{
      add_run(app),    add_campaign(app), add_fleet(app), add_check(app),    add_describe(app),
      add_list(app),   add_report(app),   add_view(app),  add_coverage(app), add_survey(app),
      add_export(app), add_capsule(app),  add_diff(app),  add_exec(app),     add_robot(app)};
  for (Subcommand& one : add_topic(app)) all.push_back(std::move(one));
  all.push_back(add_new_controller(app));
  return all;
}

/// @return exit status. @throws std::exception
int command(int argc, char** argv) {
  CLI::App app(
      "BARAKA: robots and motes that communicate by IEEE 802.11, with controllers over DDS");
  app.require_subcommand(1);
  const std::vector<Subcommand> commands = add_commands(app);
  gateway::process::complete(app, "baraka");
  gateway::process::add_manual(app, "baraka");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return gateway::process::end_of_parsing(app, e);
  }
  const auto asked =
      std::ranges::find_if(commands, [](const Subcommand& one) { return one.app->parsed(); });
  return asked->act();
}

}  // namespace

int main(int argc, char** argv) {
  return gateway::process::with_output_written(
      gateway::process::status_of_command([&] { return command(argc, argv); }));
}
