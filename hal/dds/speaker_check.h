#pragma once

#include <optional>

#include "hal/dds/process_watch.h"
#include "hal/dds/trust.h"
#include "hal/dds/udp_sender.h"
#include "hal/types/result.h"

namespace hal::dds {

/// Whether to hear a process, and whether it can be the one that it says it is. Its user is whose
/// the port is that it speaks from, whatever host it says to be of. If it says to be of this host
/// and pid namespace: it lives, has started when it says, and has that port, as far as the rights
/// of this process go (proc(5): who has a port is told to its user and root).
/// @param sender  none: not known, so that it cannot be verified.
/// @param trust  null: the user is not looked at.
/// Errors: kProtocol "pid 7 of host 'nowhere' is not heard: user 1002 has 127.0.0.1:41234", "pid 7
///   has not the port 127.0.0.1:41234 that it speaks from".
Result<void> check_speaker(const ProcessIdentity& claimed, const std::optional<UdpSender>& sender,
                           const Trust* trust);

}  // namespace hal::dds
