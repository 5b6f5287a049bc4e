#pragma once

namespace programs::netns {

/// Stretches the kernel's own timers by 1/factor, so that programs of slowed time meet what they
/// would at 1. In the network namespace of the calling thread, after its interfaces have been made.
///
/// Stretched: neighbours (ARP, RFC 826; NDP, RFC 4861): retransmission, reachable and first-probe
/// times, staleness, lock time; reassembly of IPv4 and IPv6 fragments; unsolicited reports of
/// multicast groups (IGMPv2, IGMPv3, MLDv1, MLDv2). Linux lets nobody stretch all of TCP's timers
/// (first retransmission, delayed acknowledgement), so none of them is: TCP lives in wall time.
/// @param factor  0.01 .. 1. @throws std::runtime_error  naming the file that cannot be written.
void stretch_kernel_timers(double factor);

}  // namespace programs::netns
