#pragma once

#include <string>
#include <vector>

#include "gateway/netns/descriptor.h"
#include "gateway/netns/namespaces.h"

namespace gateway::netns {

/// What holds an agent's namespaces, of this process.
struct AgentSpaces {
  FileDescriptor network, mount, host, ipc;
};

/// What baraka gets of an agent.
struct AgentEnds {
  FileDescriptor tap;       ///< Of wlan0.
  FileDescriptor counters;  ///< /proc/net/dev of the agent.
  FileDescriptor page;      ///< Of its room, memory of one RoomPage. Init keeps it open: kRoomFile.
};

struct AgentMade {
  AgentSpaces spaces;
  AgentEnds ends;
};

/// The namespaces of the calling process become the run's own: users, mounts, network, IPC, host
/// name, and, of the children it forks from then on, process numbers. It is user 0 there. No other
/// thread may exist. @throws std::runtime_error  what is refused, and how to allow it.
void enter_new_run();

/// In the first process of the run: /proc shows the run's processes only.
void mount_proc();

/// Makes the namespaces of an agent and its interfaces; the calling process stays in its own.
/// @pre this is the first process of the run, with mount_proc() done.
/// @param all  of the run, for /etc/hosts. @param factor  of the programs' time.
AgentMade make_agent(const AgentNetwork& network, const std::vector<AgentNetwork>& all,
                     double factor);

/// The calling process goes into an agent; its working folder is then the root.
void enter(const AgentSpaces& spaces);

/// Where programs find the page of their agent's room: a link to the descriptor that init has of
/// it.
inline constexpr const char* kRoomFile = "/dev/shm/.baraka-room";

}  // namespace gateway::netns
