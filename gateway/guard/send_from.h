#pragma once

#include <cstdint>

#include "gateway/guard/fastdds.h"

namespace gateway::guard {

/// Sends a datagram from a socket to each of the locators that are UDP over IPv4. The loopback
/// interface accepts or drops a datagram at once. @return whether all were accepted.
bool send_from(int socket, const rtps::octet* data, std::uint32_t size,
               rtps::LocatorsIterator& begin, const rtps::LocatorsIterator& end);

}  // namespace gateway::guard
