#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gateway::app {

struct AgentdOptions {
  std::string file;                           ///< ROBOT.yaml
  std::vector<std::string> overrides;         ///< "dotted.path=value"
  std::optional<int> domain;                  ///< Of DDS; none: BARAKA_DOMAIN, else 1.
  std::optional<int> inspect_domain;          ///< None: the same.
  std::string inspect_address = "127.0.0.1";  ///< Of the interface for topics.
  bool shown = true;                          ///< Show the agent on topics.
};

/// Serves the agent of a file until SIGTERM or SIGINT, a second one of which ends it at once.
/// SIGUSR1 is the emergency stop, SIGUSR2 releases it.
/// @return exit status.
/// @throws hal::config::ConfigErrors  every mistake in the file.
/// @throws std::runtime_error  no such interface; a port or the domain is taken.
int serve(const AgentdOptions& options);

}  // namespace gateway::app
