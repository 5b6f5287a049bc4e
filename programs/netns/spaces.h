#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "programs/netns/descriptor.h"
#include "programs/netns/namespaces.h"

namespace programs::netns {

/// What holds an agent's namespaces, of this process.
struct AgentSpaces {
  FileDescriptor users, processes, network, mount, host, ipc;
};

/// What baraka gets of an agent.
struct AgentEnds {
  FileDescriptor tap;       ///< Of wlan0.
  FileDescriptor counters;  ///< /proc/net/dev of the agent.
  FileDescriptor page;      ///< Of its room, memory of one RoomPage.
};

struct AgentMade {
  AgentSpaces spaces;
  AgentEnds ends;
  pid_t init = -1;  ///< The agent's first process, a child of the calling one.
};

/// What all agents of a run have in common.
struct RunOfAgents {
  std::vector<AgentNetwork> agents;
  double factor = 1;               ///< Of the programs' time.
  std::vector<std::string> shown;  ///< As Settings::shown.
};

/// The namespaces of the calling process become the run's own: users, mounts, network, IPC, host
/// name, and, of the children it forks from then on, process numbers. It is user 0 there. No other
/// thread may exist. @return as IdMapper::map().
/// @throws std::runtime_error  what is refused, and how to allow it.
std::string enter_new_run();

/// Makes the namespaces of the agents and their interfaces; the calling process stays in its own.
/// Users and mounts are each agent's own beneath those of the run, so that no program can take away
/// what is mounted there, nor see the run.
/// @pre this is the first process of the run, with mount_proc() done.
std::vector<AgentMade> make_agents(const RunOfAgents& run);

/// See icmp_not_sent(). The calling process is in its own network again afterwards.
std::uint64_t icmp_not_sent_by(const AgentSpaces& spaces);

/// The calling process, and what it forks from then on, goes into an agent; its working folder is
/// then the root. Its own number does not change. @pre it is user 0 of the run.
void enter(const AgentSpaces& spaces);

/// New namespaces of the calling process; what setns(2) and unshare(2) refuse is said.
/// @throws std::runtime_error
void unshare_or_fail(int what);
FileDescriptor own_namespace(const char* name);
/// @param what  of the agent, for people.
void join(const FileDescriptor& space, const char* what);

/// Where programs find the page of their agent's room: a link to the descriptor that the agent's
/// first process has of it.
inline constexpr const char* kRoomFile = "/dev/shm/.baraka-room";

}  // namespace programs::netns
