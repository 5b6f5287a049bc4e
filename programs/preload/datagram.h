#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>

namespace programs::preload {

/// What a program sends in one call.
struct Datagram {
  int socket = -1;
  const sockaddr* to = nullptr;  ///< Null: the peer to which the socket is connected.
  socklen_t to_length = 0;
  const msghdr* message = nullptr;  ///< With its control messages; null: there are none.
  std::size_t length = 0;           ///< Bytes.
};

/// Number of frames that it becomes on the agent's interface: the IP fragments of UDP, ICMP and raw
/// sockets to other hosts (RFC 791, 3.2; RFC 8200, 4.5), or the segments of UDP_SEGMENT. 0 if it
/// stays on this host, is TCP, or is not sent by a socket. Keeps errno.
/// @pre room() is not null.
std::uint32_t frames_of(const Datagram& datagram);

/// Whether data sent on this descriptor normally wait for room.
bool is_held_back(int descriptor);

/// Number of IP fragments of a datagram. @param length  bytes after the first IP header.
std::uint32_t fragments(std::size_t length, std::size_t mtu, bool is_ipv6);

}  // namespace programs::preload
