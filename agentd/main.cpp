#include <CLI/CLI.hpp>

#include "agentd/agentd.h"
#include "gateway/process/command_line.h"
#include "gateway/process/domains.h"
#include "gateway/process/manual.h"
#include "gateway/process/standard_output.h"
#include "gateway/process/status_of_command.h"
#include "gateway/server/kind_of_file.h"
#include "hal/types/log.h"

namespace {

using agentd::AgentdOptions;

/// @return exit status. @throws std::exception
int command(int argc, char** argv) {
  CLI::App app(
      "Serves a real robot or mote to controllers over DDS.\n"
      "SIGTERM and SIGINT stop the wheels, then the daemon; SIGUSR1 is the emergency stop, SIGUSR2 "
      "releases it.");
  AgentdOptions options;
  std::string name;
  app.add_option("ROBOT", options.file, "File of the robot or mote")->required();
  app.add_option("--domain", options.domain, "DDS domain; default: BARAKA_DOMAIN, else 1")
      ->transform(gateway::process::whole_number(0, gateway::process::kLastDomain));
  app.add_option("--name", name, "Name of the agent, instead of the file's");
  app.add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  app.add_option("--inspect-domain", options.inspect_domain,
                 "DDS domain of the topics; default: that of the controllers")
      ->transform(gateway::process::whole_number(0, gateway::process::kLastDomain));
  app.add_option("--inspect-address", options.inspect_address,
                 "Address of the network interface for the topics; default: 127.0.0.1");
  app.add_flag_callback(
      "--no-inspect", [&] { options.shown = false; }, "Do not show the agent to DDS tools");
  CLI::Option* state = app.add_option(
      "--state", options.state,
      "Folder that keeps the emergency stop over a restart; default: STATE_DIRECTORY, else "
      "baraka in XDG_STATE_HOME, else ~/.local/state/baraka");
  app.add_flag_callback(
         "--no-state", [&] { options.remembers = false; }, "Forget the emergency stop at a restart")
      ->excludes(state);
  std::string level = "info";
  app.add_option("--log", level, "Lowest level on standard error; default: info")
      ->transform(gateway::process::one_of({"debug", "info", "warning", "error"}));
  gateway::process::complete(app, "baraka-agentd");
  gateway::process::add_manual(app, "baraka-agentd");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return gateway::process::end_of_parsing(app, e);
  }
  hal::log::set_level(*hal::log::level_called(level));
  if (!name.empty()) options.overrides.push_back("agent.name=" + name);
  return gateway::server::with_hardware_file(options.file, [&] { return agentd::serve(options); });
}

}  // namespace

int main(int argc, char** argv) {
  return gateway::process::with_output_written(
      gateway::process::status_of_command([&] { return command(argc, argv); }));
}
