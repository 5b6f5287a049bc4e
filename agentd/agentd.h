#pragma once

#include <optional>
#include <string>
#include <vector>

namespace agentd {

struct AgentdOptions {
  std::string file;                           ///< ROBOT.yaml
  std::vector<std::string> overrides;         ///< "dotted.path=value"
  std::optional<int> domain;                  ///< DDS domain; none: BARAKA_DOMAIN, else 1.
  std::optional<int> inspect_domain;          ///< Domain for topics; none: the same.
  std::string inspect_address = "127.0.0.1";  ///< Address of the interface for topics.
  bool shown = true;                          ///< Whether the agent is shown on topics.
  std::string state;                          ///< Folder; empty: default_state_folder().
  bool remembers = true;  ///< Whether the emergency stop is remembered over a restart.
};

/// Serves the agent of a file until SIGTERM or SIGINT; a second one ends it at once. SIGUSR1 is the
/// emergency stop, SIGUSR2 releases it. Controllers may connect from the beginning; the line
/// "ready: …", and READY=1 for the service manager, follow when every device has answered.
/// @return exit status.
/// @throws hal::files::config::ConfigErrors  every mistake in the file, and an interface, address
/// or port in it that this computer does not have.
/// @throws UsageError  the state cannot be stored.  @throws gateway::process::NoSuchDomain
/// @throws std::runtime_error  a condition that may be temporary: a port or the domain is taken.
int serve(const AgentdOptions& options);

}  // namespace agentd
