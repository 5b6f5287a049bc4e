#pragma once

#include <vector>

#include "programs/netns/namespaces.h"

namespace programs::netns {

/// Adds the agent's routes in the network namespace of the calling thread, whose interfaces have
/// been made, and makes it a router if the agent forwards packets. No effect if it has no routes
/// and forwards none.
///
/// A router sends a packet out by the interface by which it came, since an agent has only one, and
/// the kernel would therefore tell the source by an ICMP redirect to use the next hop, or the
/// destination, directly. But the source may not hear them: the radio's links are not those of the
/// common Ethernet that redirects assume (RFC 1812, 5.2.7.2; RFC 4861, 8). So redirects are neither
/// sent nor accepted. For those of IPv6, which Linux has no setting not to send, all routes are via
/// link-local addresses: no redirect goes to a source that is reached via a router.
/// @throws std::runtime_error  what is refused.
void set_routes(const AgentNetwork& own);

}  // namespace programs::netns
