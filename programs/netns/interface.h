#pragma once

#include "programs/netns/descriptor.h"
#include "programs/netns/namespaces.h"

namespace programs::netns {

inline constexpr const char* kInterface = "wlan0";

/// Whether the mtu is large enough for IPv6 (RFC 8200, 5), and this kernel has IPv6.
bool has_ipv6(const AgentNetwork& network);

/// Makes the agent's `wlan0` and brings it and `lo` up, in the network namespace of the calling
/// thread: a TAP with the agent's MAC address, its mtu, a queue of 10,000 frames, its IPv4 address,
/// a route for all multicast groups, and, if the mtu is at least 1280 bytes, link-local and unique
/// local IPv6 addresses without duplicate address detection.
/// @return the other end of the TAP, non-blocking. @throws std::runtime_error  what is refused.
FileDescriptor make_interfaces(const AgentNetwork& network);

}  // namespace programs::netns
