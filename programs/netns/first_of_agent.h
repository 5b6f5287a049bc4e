#pragma once

#include "programs/netns/spaces.h"

namespace programs::netns {

/// Starts the first process of an agent, without waiting for it. It has its own process namespace,
/// in which it is process 1, and its own mounts; it reaps orphaned processes there, and has no open
/// file except the page of the agent's room. The kernel kills it when the run's first process ends,
/// and then the agent's processes.
/// @param made  the agent's other namespaces and the page; the process is stored there.
/// @return for await_first_of_agent(). @throws std::runtime_error  what is refused.
FileDescriptor start_first_of_agent(const AgentNetwork& network, const RunOfAgents& run,
                                    AgentMade& made);

/// Waits until the process has made everything. @param made  the other namespaces are stored there.
/// @throws std::runtime_error  what was refused.
void await_first_of_agent(const FileDescriptor& report, AgentMade& made);

}  // namespace programs::netns
