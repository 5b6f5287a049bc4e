#pragma once

#include "hal/routing/algorithm.h"
#include "sim/radio/frame.h"
#include "sim/radio/mac_sap.h"
#include "sim/record/protocols.h"

namespace sim::record {

/// What routing sent in a frame, as the protocol of who sent it says; "" if it is not routing's.
hal::routing::FrameName packet_name(const radio::Frame& frame, const Protocols& protocols);

/// The same of a frame that `source` asks for.
hal::routing::FrameName packet_name(const radio::MacRequest& request, hal::AgentId source,
                                    const Protocols& protocols);

}  // namespace sim::record
