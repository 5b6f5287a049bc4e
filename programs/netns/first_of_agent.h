#pragma once

#include "programs/netns/spaces.h"

namespace programs::netns {

/// Starts the first process of an agent, and does not wait for it: it has process numbers of its
/// own, in which it is 1, and mounts of its own; it reaps what loses its parent there, and has
/// nothing open but the page of the agent's room. The kernel ends it with the run's first process,
/// and the agent's with it.
/// @param made  its other namespaces, and the page; gets the process.
/// @return for await_first_of_agent(). @throws std::runtime_error  what is refused.
FileDescriptor start_first_of_agent(const AgentNetwork& network, const RunOfAgents& run,
                                    AgentMade& made);

/// Waits until all is made. @param made  gets the rest of its namespaces.
/// @throws std::runtime_error  what was refused.
void await_first_of_agent(const FileDescriptor& report, AgentMade& made);

}  // namespace programs::netns
