#pragma once

#include <vector>

#include "programs/netns/namespaces.h"

namespace programs::netns {

/// Reserves an entry for each other agent in the neighbour tables (ARP, NDP) of the network
/// namespace of the calling thread. The entries contain no address: a sender still requests the
/// address of a neighbour over the air first.
///
/// Reason: all namespaces of a machine share one table of 1024 entries (gc_thresh3 of arp(7)),
/// which only root of the machine could enlarge. With 33 or more agents that all communicate, or
/// with two runs at the same time, sending would fail with "neighbor table overflow". Externally
/// managed entries (NTF_EXT_LEARNED) are not counted. With more than 128 agents there would be too
/// many of them, and none are reserved.
/// @throws std::runtime_error
void keep_places(const AgentNetwork& own, const std::vector<AgentNetwork>& all);

}  // namespace programs::netns
