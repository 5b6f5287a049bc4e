#pragma once

#include <string_view>

#include "sim/radio/frame.h"

namespace sim::record {

/// Class of a frame, as the tables name it.
inline std::string_view class_of(const radio::Frame& frame) {
  switch (frame.type) {
    case radio::FrameType::kRts:
      return "rts";
    case radio::FrameType::kCts:
      return "cts";
    case radio::FrameType::kAck:
      return "ack";
    case radio::FrameType::kData:
      break;
  }
  return frame.is_broadcast() ? "broadcast" : "unicast";
}

}  // namespace sim::record
