#pragma once

#include "hal/rtps/fault.h"
#include "hal/rtps/limits.h"
#include "hal/rtps/submessage.h"

namespace hal::rtps {

/// Judges submessages that carry no samples: HEARTBEAT, ACKNACK, GAP, NACK_FRAG, HEARTBEAT_FRAG
/// and INFO_* (OMG DDSI-RTPS 2.5, 8.3.7 and 9.4.5). Padding, what is encrypted, and what later
/// versions and vendors have added pass: receivers skip it.
/// @param source  participant that the submessages so far are from; changed by INFO_SRC.
/// @param[out] sequence_number  the first that a HEARTBEAT tells of.
Objection judge_control(const Submessage& submessage, const Limits& limits, GuidPrefix& source,
                        std::int64_t& sequence_number);

}  // namespace hal::rtps
