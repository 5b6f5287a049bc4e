#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "gateway/app/agentd.h"
#include "gateway/app/exit_status.h"
#include "hal/config/errors.h"
#include "hal/dds/domains.h"

namespace {

using gateway::app::AgentdOptions;

constexpr int kLastDomain = 232;

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
      ->check(CLI::Range(0, kLastDomain));
  app.add_option("--name", name, "Name of the agent, instead of the file's");
  app.add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  app.add_option("--inspect-domain", options.inspect_domain,
                 "DDS domain of the topics; default: that of the controllers")
      ->check(CLI::Range(0, kLastDomain));
  app.add_option("--inspect-address", options.inspect_address,
                 "Address of the network interface for the topics; default: 127.0.0.1");
  app.add_flag("!--no-inspect", options.shown, "Do not show the agent to DDS tools");
  CLI::Option* state = app.add_option(
      "--state", options.state,
      "Folder that remembers the emergency stop over a restart; default: STATE_DIRECTORY, else "
      "baraka in XDG_STATE_HOME, else ~/.local/state/baraka");
  app.add_flag("!--no-state", options.remembers, "Forget the emergency stop at a restart")
      ->excludes(state);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int status = app.exit(e);
    return status == 0 ? gateway::app::kDone : gateway::app::kUsage;
  }
  if (!name.empty()) options.overrides.push_back("agent.name=" + name);
  return gateway::app::serve(options);
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
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return gateway::app::kRunFailed;
  }
}
