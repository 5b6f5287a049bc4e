#pragma once

#include "hal/rtps/fault.h"
#include "hal/rtps/limits.h"
#include "hal/rtps/submessage.h"

namespace hal::rtps {

/// Checks submessages that carry no samples: HEARTBEAT, ACKNACK, GAP, NACK_FRAG, HEARTBEAT_FRAG and
/// INFO_* (OMG DDSI-RTPS 2.5, 8.3.7 and 9.4.5). Accepts padding, encrypted submessages, and those
/// of later versions and vendors: receivers skip them.
/// @param source  participant from which the submessages so far come; changed by INFO_SRC.
/// @param[out] sequence_number  the first sequence number of a HEARTBEAT.
Objection judge_control(const Submessage& submessage, const Limits& limits, GuidPrefix& source,
                        std::int64_t& sequence_number);

}  // namespace hal::rtps
