#pragma once

#include <string>
#include <vector>

#include "hal/node/exchange/ports.h"
#include "hal/types/agent_id.h"
#include "hal/types/result.h"

namespace gateway::runtime {

/// Agents whose controllers share one state in memory, as those of one process do.
struct InProcessControllers {
  std::string process;  ///< Its name, for messages.
  std::string program;  ///< A plug-in or a Python file in controller_folders().
  std::vector<hal::AgentId> agents;
};

/// Makes the controllers of these agents in this process and connects them to the host.
/// @param offers  of the host, among them those of the agents.
/// Errors: of load_plugin(), session_for() and ControllerHost::create().
hal::Result<void> connect_in_process(const InProcessControllers& controllers,
                                     const std::vector<hal::node::exchange::AgentOffer>& offers,
                                     hal::node::exchange::AgentHost& host);

}  // namespace gateway::runtime
