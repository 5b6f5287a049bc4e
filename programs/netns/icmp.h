#pragma once

#include <cstddef>
#include <cstdint>

namespace programs::netns {

/// Limits the rate of ICMP errors (destination unreachable, time exceeded) that the kernel sends
/// for an agent, in the network namespace of the calling thread; echo replies are not limited.
///
/// Since Linux 5.18 all namespaces of a computer send ICMP through one socket per processor. That
/// socket accepts no more while about 130 kB are queued (icmp_init() of net/ipv4/icmp.c: two
/// packets of 64 kB), which are a hundred errors that wait for the address of a neighbour, three
/// seconds each; what it does not accept, including pings of any agent, is never sent. By icmp(7)
/// each agent may send six errors at once to each other agent. So with more than four agents, the
/// rates are set such that all agents together have at most this number waiting, as far as the
/// lowest rate, one per second, permits. No effect if the kernel has one limit for all namespaces
/// (before Linux 6.12).
/// @param agents  number of agents of the run.
/// @throws std::runtime_error  with the file that cannot be written.
void bound_icmp_errors(std::size_t agents);

/// For lock-step: the kernel limits ICMP errors, v4 and v6, by the wall clock, so that equal runs
/// would send different numbers of them. In the network namespace of the calling thread they are
/// not limited any more. @throws std::runtime_error  with the file that cannot be written.
void unbound_icmp_errors();

/// Number of ICMP messages, v4 and v6, that the kernel could not send, in the network namespace of
/// the calling thread: OutErrors of /proc/net/snmp, Icmp6OutErrors of snmp6.
std::uint64_t icmp_not_sent();

}  // namespace programs::netns
