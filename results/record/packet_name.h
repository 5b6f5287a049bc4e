#pragma once

#include "hal/node/routing/algorithm.h"
#include "results/record/protocols.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/mac_sap.h"

namespace results::record {

/// Kind of the routing packet in a frame, in the words of the transmitter's protocol; "" if the
/// frame has none.
hal::node::routing::FrameName packet_name(const sim::radio::Frame& frame,
                                          const Protocols& protocols);

/// The same for an MSDU of an A-MSDU.
hal::node::routing::FrameName packet_name(const sim::radio::AmsduPart& msdu,
                                          const Protocols& protocols);

/// The same for a frame that `source` asks its radio to send.
hal::node::routing::FrameName packet_name(const sim::radio::MacRequest& request,
                                          hal::AgentId source, const Protocols& protocols);

}  // namespace results::record
