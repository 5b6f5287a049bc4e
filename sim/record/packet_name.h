#pragma once

#include <optional>
#include <string_view>

#include "sim/radio/frame.h"
#include "sim/record/message_in.h"

namespace sim::record {

/// What routing sent in a frame.
struct PacketName {
  std::string_view kind;  ///< "data", "forward ant", "hello", "RREQ", …; "" if it is not routing's.
  std::optional<MessageName> message;  ///< Of a controller.
};

PacketName packet_name(const radio::Frame& frame);

}  // namespace sim::record
