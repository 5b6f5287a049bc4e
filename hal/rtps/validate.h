#pragma once

#include <optional>

#include "hal/rtps/fault.h"
#include "hal/rtps/limits.h"
#include "hal/rtps/walk.h"
#include "hal/types/result.h"

namespace hal::rtps {

/// Checks a datagram: every field that a receiver would use, of every submessage, without
/// allocation. Any thread.
/// @param[out] highest  raised to the highest sequence number of a sample, or first one in a
///   HEARTBEAT, if that is greater; unchanged if there is a fault.
/// @return the reason to refuse the datagram; nullopt if there is none.
std::optional<Fault> fault_in(Octets datagram, const Limits& limits, std::int64_t& highest);
std::optional<Fault> fault_in(Octets datagram, const Limits& limits = {});

/// The same with the reason as an error message.
/// Errors: kProtocol "octet 24: DATA: its payload is too short".
Result<void> validate(Octets datagram, const Limits& limits = {});

}  // namespace hal::rtps
