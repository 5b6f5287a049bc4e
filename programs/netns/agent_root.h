#pragma once

#include <string>
#include <vector>

#include "programs/netns/namespaces.h"

namespace programs::netns {

/// Mounts the folders that an agent does not share, over the mounts of the calling process: `/tmp`,
/// `/run`, `/dev/shm`, `/etc/hosts`, `/sys` of its network, and `/proc` of its processes, in which
/// only files of its processes and its network are writable. The mounts are locked as soon as a
/// user namespace below this one gets a copy of them.
/// @pre the process is the first of the agent's, is in its network, and has a copy of the mounts.
/// @throws std::runtime_error  one sentence: what is refused, and how to allow it.
void mount_agent_root(const AgentNetwork& network, const std::vector<AgentNetwork>& all,
                      const std::vector<std::string>& shown);

/// Mounts /proc for the process namespace of the calling process. @throws std::runtime_error
void mount_proc();

}  // namespace programs::netns
