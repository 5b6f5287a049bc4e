#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>

namespace programs::preload {

/// What a program sends at once.
struct Datagram {
  int socket = -1;
  const sockaddr* to = nullptr;  ///< Null: where the socket is connected to.
  socklen_t to_length = 0;
  const msghdr* message = nullptr;  ///< With its control messages; null: there are none.
  std::size_t length = 0;           ///< Bytes.
};

/// How many frames it becomes on the agent's interface: the IP fragments of what UDP, ICMP and raw
/// sockets send to others (RFC 791, 3.2; RFC 8200, 4.5), or the segments of UDP_SEGMENT. 0: none of
/// that, for it stays on this host, is TCP, or is no socket at all. Leaves errno as it is.
/// @pre room() is not null.
std::uint32_t frames_of(const Datagram& datagram);

/// Whether what is sent by this descriptor as a rule waits for room.
bool is_held_back(int descriptor);

/// IP fragments of a datagram. @param length  bytes behind the first IP header.
std::uint32_t fragments(std::size_t length, std::size_t mtu, bool is_ipv6);

}  // namespace programs::preload
