#pragma once

namespace programs::netns {

/// Whether one of the connections in a table of the kernel's waits for a timer that the kernel
/// follows by the wall clock: to send again what was not acknowledged, or to ask whether a closed
/// window is open.
/// @param table  /proc/net/tcp or tcp6 (Documentation/networking/proc_net_tcp.rst), at any place;
///   -1: there is none.
bool has_tcp_timer(int table);

}  // namespace programs::netns
