#pragma once

#include <string>
#include <vector>

#include "programs/netns/namespaces.h"

namespace programs::netns {

/// Mounts what an agent has of its own, over the mounts of the calling process: `/tmp`, `/run`,
/// `/dev/shm`, `/etc/hosts`, `/sys` of its network, and `/proc` of its processes, in which only
/// what is theirs can be written. They are locked once a user namespace beneath this one gets a
/// copy of them.
/// @pre the process is the first of the agent's, is in its network, and its mounts are a copy.
/// @throws std::runtime_error  one sentence: what is refused, and how to allow it.
void mount_agent_root(const AgentNetwork& network, const std::vector<AgentNetwork>& all,
                      const std::vector<std::string>& shown);

/// /proc shows the processes of the calling process's namespace. @throws std::runtime_error
void mount_proc();

}  // namespace programs::netns
