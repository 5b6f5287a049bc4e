#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "programs/netns/descriptor.h"
#include "programs/netns/namespaces.h"
#include "programs/netns/program_time.h"

namespace programs::netns {

/// File descriptors of this process that keep an agent's namespaces.
struct AgentSpaces {
  FileDescriptor users, processes, network, mount, host, ipc;
};

/// What baraka receives for an agent.
struct AgentEnds {
  FileDescriptor tap;       ///< The other end of wlan0.
  FileDescriptor counters;  ///< /proc/net/dev of the agent.
  FileDescriptor tcp;       ///< /proc/net/tcp of the agent.
  FileDescriptor tcp6;      ///< The same of IPv6, or of IPv4 once more without IPv6.
  FileDescriptor page;      ///< Shared memory with the RoomPage and the WaitPage of the agent.
};

struct AgentMade {
  AgentSpaces spaces;
  AgentEnds ends;
  pid_t init = -1;  ///< The agent's first process, a child of the calling one.
};

/// Settings that are common to all agents of a run.
struct RunOfAgents {
  std::vector<AgentNetwork> agents;
  ProgramTime time;
  std::vector<std::string> shown;  ///< As Settings::shown.
};

/// Moves the calling process into new namespaces for the run: users, mounts, network, IPC, host
/// name, and, for children that it forks later, process ids. It is user 0 there. It must have only
/// one thread.
/// @return as IdMapper::map(). @throws std::runtime_error  what is refused, and how to allow it.
std::string enter_new_run();

/// Makes the namespaces of the agents and their interfaces; the calling process stays in its own.
/// Each agent has its own user and mount namespaces below those of the run, so that no program can
/// unmount what is mounted there, or see the run.
/// @pre this is the first process of the run, and has called mount_proc().
std::vector<AgentMade> make_agents(const RunOfAgents& run);

/// See icmp_not_sent(). The calling process is in its own network namespace again afterwards.
std::uint64_t icmp_not_sent_by(const AgentSpaces& spaces);

/// Moves the calling process, and the children that it forks later, into an agent; its working
/// folder is then the root. Its own process id does not change. @pre it is user 0 of the run.
void enter(const AgentSpaces& spaces);

/// unshare(2), with a message if it is refused.
/// @throws std::runtime_error
void unshare_or_fail(int what);
FileDescriptor own_namespace(const char* name);
/// setns(2), with a message if it is refused. @param what  name of the agent's namespace, for
/// messages.
void join(const FileDescriptor& space, const char* what);

/// Where programs find the page of their agent's room: a link to the descriptor that the agent's
/// first process has for it.
inline constexpr const char* kRoomFile = "/dev/shm/.baraka-room";

}  // namespace programs::netns
