#pragma once

namespace programs::netns {

/// Stretches timers of the kernel by 1/factor, so that programs whose time is slowed observe the
/// same intervals as at factor 1. Acts on the network namespace of the calling thread; call it
/// after its interfaces have been made.
///
/// Stretched are: for neighbours (ARP, RFC 826; NDP, RFC 4861) the retransmission, reachable and
/// first-probe times, staleness and lock time; reassembly of IPv4 and IPv6 fragments; unsolicited
/// reports of multicast groups (IGMPv2, IGMPv3, MLDv1, MLDv2). Linux does not allow stretching all
/// timers of TCP (first retransmission, delayed acknowledgement), so none of them is stretched: TCP
/// runs in wall time.
/// @param factor  0.01 .. 1. @throws std::runtime_error  with the file that cannot be written.
void stretch_kernel_timers(double factor);

/// For lock-step, in which virtual time may stand or run far ahead: none of these timers is to
/// expire while a run lasts, nor does the kernel send anything by a timer or at random: router
/// solicitations, flow labels. What it sends for multicast groups, its users drop.
/// @throws std::runtime_error  naming the file that cannot be written.
void hold_kernel_timers();

}  // namespace programs::netns
