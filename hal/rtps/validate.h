#pragma once

#include <optional>

#include "hal/rtps/fault.h"
#include "hal/rtps/limits.h"
#include "hal/rtps/walk.h"
#include "hal/types/result.h"

namespace hal::rtps {

/// What a datagram is refused for: every field that a receiver follows, of every submessage, is
/// looked at before it is; nothing is allocated. Any thread.
/// @param[out] highest  sequence number of a sample or the first of a HEARTBEAT, if it is above
/// what
///   stood there; only if nothing is wrong.
std::optional<Fault> fault_in(Octets datagram, const Limits& limits, std::int64_t& highest);
std::optional<Fault> fault_in(Octets datagram, const Limits& limits = {});

/// The same for whoever prefers a sentence.
/// Errors: kProtocol "octet 24: DATA: its payload is too short".
Result<void> validate(Octets datagram, const Limits& limits = {});

}  // namespace hal::rtps
