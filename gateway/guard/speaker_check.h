#pragma once

#include <optional>

#include "gateway/guard/trust.h"
#include "gateway/guard/udp_sender.h"
#include "gateway/process/process_watch.h"
#include "hal/types/result.h"

namespace gateway::guard {

/// Decides whether to accept data of a process, and whether it is the process that it claims to be.
/// Its user is the owner of its source port, whatever host it claims. A process that claims this
/// host and pid namespace must be alive, must have started at the stated time and must own the
/// port, as far as this process may know (proc(5): only its user and root can see who owns a port).
/// @param sender  nullopt: unknown, so it cannot be verified.
/// @param trust  null: the user is not checked.
/// Errors: kProtocol "pid 7 of host 'nowhere' is not heard: user 1002 has 127.0.0.1:41234", "pid 7
/// has not the port 127.0.0.1:41234 that it speaks from".
hal::Result<void> check_speaker(const process::ProcessIdentity& claimed,
                                const std::optional<UdpSender>& sender, const Trust* trust);

}  // namespace gateway::guard
