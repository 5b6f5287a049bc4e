#pragma once

#include <sys/types.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string_view>
#include <vector>

#include "gateway/guard/udp_sender.h"

namespace gateway::guard {

/// A UDP socket of this network namespace that can send to IPv4 addresses, from the kernel's table.
struct TableSocket {
  std::uint32_t address = 0;    ///< Bound address, as a number; 0: any.
  std::uint16_t port = 0;       ///< Bound port.
  bool may_be_of_ipv6 = false;  ///< Bound to any IPv6 address, perhaps IPv4 as well.
  uid_t user = 0;               ///< User id of the creator, in the reader's user namespace.
  std::uint64_t inode = 0;      ///< As in /proc/<pid>/fd.
  bool operator==(const TableSocket&) const = default;
};

/// Parses a line of /proc/net/udp or /proc/net/udp6 (proc(5); Linux, net/ipv4/udp.c,
/// udp4_format_sock(), and net/ipv6/udp.c). Nullopt for a heading, a socket that cannot send to
/// IPv4 addresses, or an invalid line.
std::optional<TableSocket> table_socket(std::string_view line);

/// The sockets with a port in two such files.
std::vector<TableSocket> sockets_with(std::uint16_t port, std::istream& udp, std::istream& udp6);

/// The sockets that a datagram can come from, at this time; empty: the socket has been closed. A
/// socket that is bound to another address of this host is included, because its user can give the
/// sender's address as the source of a datagram (ip(7), IP_PKTINFO); it is not if the port is bound
/// to any address, which Linux lets nobody share. Nullopt if /proc/net/udp cannot be read.
std::optional<std::vector<TableSocket>> sockets_behind(const UdpSender& sender);

}  // namespace gateway::guard
