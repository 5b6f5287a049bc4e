#pragma once

#include "hal/node/routing/algorithm.h"
#include "results/record/protocols.h"
#include "sim/radio/frame.h"
#include "sim/radio/mac_sap.h"

namespace results::record {

/// What routing sent in a frame, as the protocol of who sent it says; "" if it is not routing's.
hal::node::routing::FrameName packet_name(const sim::radio::Frame& frame,
                                          const Protocols& protocols);

/// The same of a frame that `source` asks for.
hal::node::routing::FrameName packet_name(const sim::radio::MacRequest& request,
                                          hal::AgentId source, const Protocols& protocols);

}  // namespace results::record
