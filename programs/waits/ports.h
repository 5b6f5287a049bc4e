#pragma once

namespace programs::waits {

/// Binds an IPv4 or IPv6 socket that has no port yet to one of the run's own, counted from 40,000
/// on, where the kernel would draw one at random. Leaves errno as it is.
void give_port(int socket);

/// Nothing that was known of an earlier socket of this number holds for a new one.
void forget(int socket);

}  // namespace programs::waits
