#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/result.h"
#include "hal/types/time.h"

namespace gateway::server {

/// A controller to be started inside its agent's network.
struct InsideProgram {
  std::vector<std::string> arguments;  ///< The first is the program, with its folder.
  std::vector<std::pair<std::string, std::string>> environment;  ///< Added to this process's own.
  std::filesystem::path log;  ///< Its standard output and error are appended here.
  /// Descriptors of this process that it keeps; in lock-step numbered from 3 on, in this order.
  std::vector<int> inherited = {};
  std::string name = {};  ///< For messages; empty: the program's file name.
};

/// Starts controllers inside their agents' networks. They end with this object.
class InsideStarter {
 public:
  virtual ~InsideStarter() = default;

  /// @throws std::runtime_error  it cannot be started.
  virtual void start(hal::AgentId agent, const InsideProgram& program) = 0;

  /// Whether the controllers are held in lock-step.
  virtual bool holds() const { return false; }
  /// In lock-step: lets the programs of an agent, the controller among them, go on until all wait.
  /// @param now  simulated time, which does not pass meanwhile.
  /// @param may_go_on  asked now and then meanwhile; once false, they do not go on any more.
  virtual void give_turns(hal::AgentId agent, hal::Time now,
                          const std::function<bool()>& may_go_on) {
    (void)agent, (void)now, (void)may_go_on;
  }

  /// Whether all started controllers are running. Use it only before the run; during the run others
  /// are told of ends. Errors: kNotConnected, with the name of the first that ended, how, and its
  /// last line.
  virtual hal::Result<void> check() = 0;
};

}  // namespace gateway::server
