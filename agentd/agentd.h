#pragma once

#include <optional>
#include <string>
#include <vector>

namespace agentd {

struct AgentdOptions {
  std::string file;                           ///< ROBOT.yaml
  std::vector<std::string> overrides;         ///< "dotted.path=value"
  std::optional<int> domain;                  ///< Of DDS; none: BARAKA_DOMAIN, else 1.
  std::optional<int> inspect_domain;          ///< None: the same.
  std::string inspect_address = "127.0.0.1";  ///< Of the interface for topics.
  bool shown = true;                          ///< Show the agent on topics.
  std::string state;                          ///< Folder; empty: default_state_folder().
  bool remembers = true;                      ///< The emergency stop, over a restart.
};

/// Serves the agent of a file until SIGTERM or SIGINT, a second one of which ends it at once.
/// SIGUSR1 is the emergency stop, SIGUSR2 releases it. Controllers may come from the beginning; the
/// line "ready: …", and READY=1 for the service manager, come when every device has answered.
/// @return exit status.
/// @throws hal::files::config::ConfigErrors  every mistake in the file, and an interface, address
/// or port
///   of it that this computer does not have.
/// @throws UsageError  no state can be kept.  @throws gateway::process::NoSuchDomain
/// @throws std::runtime_error  what may pass: a port or the domain is taken.
int serve(const AgentdOptions& options);

}  // namespace agentd
