#pragma once

#include <cstdint>

#include "gateway/guard/fastdds.h"

namespace gateway::guard {

/// Sends a datagram from a socket to each of those locators that are of UDP over IPv4. Loopback
/// takes a datagram or drops it, at once. @return whether all were taken.
bool send_from(int socket, const rtps::octet* data, std::uint32_t size,
               rtps::LocatorsIterator& begin, const rtps::LocatorsIterator& end);

}  // namespace gateway::guard
