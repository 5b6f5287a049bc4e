#pragma once

#include <sys/types.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string_view>
#include <vector>

#include "gateway/guard/udp_sender.h"

namespace gateway::guard {

/// A UDP socket of this network namespace that can send to IPv4 addresses, as the kernel tells of
/// it.
struct TableSocket {
  std::uint32_t address = 0;    ///< That it is bound to, as a number; 0: any.
  std::uint16_t port = 0;       ///< The same.
  bool may_be_of_ipv6 = false;  ///< Bound to any address of IPv6, and perhaps of IPv4, too.
  uid_t user = 0;               ///< Of who made it, as numbered in the reader's user namespace.
  std::uint64_t inode = 0;      ///< As in /proc/<pid>/fd.
  bool operator==(const TableSocket&) const = default;
};

/// Reads a line of /proc/net/udp or /proc/net/udp6 (proc(5); Linux, net/ipv4/udp.c,
/// udp4_format_sock(), and net/ipv6/udp.c). Nothing: a heading, a socket that cannot send to IPv4
/// addresses, or what these files do not hold.
std::optional<TableSocket> table_socket(std::string_view line);

/// Those of two such files that have a port.
std::vector<TableSocket> sockets_with(std::uint16_t port, std::istream& udp, std::istream& udp6);

/// The sockets that a datagram may come from, as of now; empty: it has been closed. One bound to
/// another address of this host is among them: its user may name the sender's as the source of a
/// datagram (ip(7), IP_PKTINFO), unless there is one at the port that is bound to any address,
/// which Linux lets nobody share. Nothing if /proc/net/udp cannot be read.
std::optional<std::vector<TableSocket>> sockets_behind(const UdpSender& sender);

}  // namespace gateway::guard
