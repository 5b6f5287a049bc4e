#pragma once

#include <vector>

#include "programs/netns/namespaces.h"

namespace programs::netns {

/// Keeps a place for each other agent in the neighbour tables (ARP, NDP) of the network namespace
/// that the calling thread is in. Nothing is in the places: who sends to a neighbour still asks the
/// air for its address first.
///
/// For all namespaces of a machine share one table of 1024 entries (gc_thresh3 of arp(7)), of which
/// only root of the machine could make more: from 33 agents that all talk on, or with two runs side
/// by side, sends would fail with "neighbor table overflow". Entries that somebody keeps
/// (NTF_EXT_LEARNED) are not counted. Above 128 agents there would be too many of them, and none
/// are kept.
/// @throws std::runtime_error
void keep_places(const AgentNetwork& own, const std::vector<AgentNetwork>& all);

}  // namespace programs::netns
