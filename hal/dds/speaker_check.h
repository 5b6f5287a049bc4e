#pragma once

#include <optional>
#include <string>

#include "hal/dds/datagram_filter.h"
#include "hal/dds/process_watch.h"
#include "hal/types/result.h"

namespace hal::dds {

/// The inode of the socket that has a UDP port, as /proc/net/udp tells it; empty: nobody has it.
/// Nothing if there is no such file.
std::optional<std::string> socket_at(const UdpSender& sender);

/// Whether a process can be the one that it says it is: it lives, has started when it says, and has
/// the UDP port that it speaks from. Only of processes of this host, and as far as the rights of
/// this one go (proc(5): who has a port is told to its user and root); of others nothing is known.
/// @param sender  none: not known.
/// Errors: kProtocol "pid 7 has not the port 127.0.0.1:41234 that it speaks from".
Result<void> check_speaker(const ProcessIdentity& claimed, const std::optional<UdpSender>& sender);

/// Whether this process deals with one of another user of this host: persons deal with themselves,
/// with root and with users of services (below 1000), and those with everybody.
/// Errors: kProtocol "pid 7 is of user 1001, this is user 1000".
Result<void> check_user(const ProcessIdentity& claimed);

}  // namespace hal::dds
