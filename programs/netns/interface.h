#pragma once

#include "programs/netns/descriptor.h"
#include "programs/netns/namespaces.h"

namespace programs::netns {

inline constexpr const char* kInterface = "wlan0";

/// Whether its mtu is one of IPv6 (RFC 8200, 5), and this kernel has that.
bool has_ipv6(const AgentNetwork& network);

/// Makes the agent's `wlan0` and brings it and `lo` up, in the network namespace of the calling
/// thread: a TAP with the agent's MAC address, its mtu, a queue of 10,000 frames, its IPv4 address,
/// the route of all multicast groups, and, from an mtu of 1280 bytes on, link-local and unique
/// local IPv6 addresses, which need no duplicate address detection.
/// @return the TAP's other end, non-blocking. @throws std::runtime_error  what is refused.
FileDescriptor make_interfaces(const AgentNetwork& network);

}  // namespace programs::netns
