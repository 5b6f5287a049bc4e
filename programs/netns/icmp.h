#pragma once

#include <cstddef>
#include <cstdint>

namespace programs::netns {

/// Bounds how many errors (destination unreachable, time exceeded) the kernel sends for an agent,
/// in the network namespace of the calling thread; echo replies are not bounded.
///
/// Since Linux 5.18 all namespaces of a computer send ICMP through one socket per processor. It
/// takes no more while it has some 130 kB under way (icmp_init() of net/ipv4/icmp.c: two packets of
/// 64 kB), which is a hundred errors that wait for the address of a neighbour, three seconds each;
/// and what it does not take, pings of any agent among it, is never sent. So above four agents, of
/// which each may by icmp(7) send six errors at once to each other one, all together may have so
/// many waiting, as far as the least rate, one a second, allows. Without effect where the kernel
/// has one bound for all namespaces (before Linux 6.12).
/// @param agents  of the run. @throws std::runtime_error  naming the file that cannot be written.
void bound_icmp_errors(std::size_t agents);

/// Messages of ICMP, v4 and v6, that the kernel was to send and could not, of the network namespace
/// of the calling thread: OutErrors of /proc/net/snmp, Icmp6OutErrors of snmp6.
std::uint64_t icmp_not_sent();

}  // namespace programs::netns
