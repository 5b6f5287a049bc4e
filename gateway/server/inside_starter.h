#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/result.h"

namespace gateway::server {

/// A controller to be started inside its agent's network.
struct InsideProgram {
  std::vector<std::string> arguments;  ///< The first is the program, with its folder.
  std::vector<std::pair<std::string, std::string>> environment;  ///< Added to this process's own.
  std::filesystem::path log;        ///< Its standard output and error are appended here.
  std::vector<int> inherited = {};  ///< Descriptors of this process that it keeps.
};

/// Starts controllers inside their agents' networks. They end with this object.
class InsideStarter {
 public:
  virtual ~InsideStarter() = default;

  /// @throws std::runtime_error  it cannot be started.
  virtual void start(hal::AgentId agent, const InsideProgram& program) = 0;

  /// Whether all started controllers are running. Use it only before the run; during the run others
  /// are told of ends. Errors: kNotConnected, with the name of the first that ended, how, and its
  /// last line.
  virtual hal::Result<void> check() = 0;
};

}  // namespace gateway::server
