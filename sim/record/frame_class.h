#pragma once

#include <cstdint>
#include <string_view>

#include "sim/radio/frame.h"

namespace sim::record {

/// Class of a frame, as the tables have it.
enum class FrameClass : std::uint8_t {
  kRts,
  kCts,
  kAck,
  kBroadcast,
  kUnicast,
  kBeacon,
  kManagement,
};
inline constexpr int kFrameClasses = 7;

inline FrameClass frame_class(const radio::Frame& frame) {
  switch (frame.type) {
    case radio::FrameType::kRts:
      return FrameClass::kRts;
    case radio::FrameType::kCts:
      return FrameClass::kCts;
    case radio::FrameType::kAck:
      return FrameClass::kAck;
    case radio::FrameType::kBeacon:
      return FrameClass::kBeacon;
    default:
      break;
  }
  if (radio::is_management(frame.type)) return FrameClass::kManagement;
  return frame.is_broadcast() ? FrameClass::kBroadcast : FrameClass::kUnicast;
}

inline std::string_view name(FrameClass kind) {
  constexpr std::string_view kNames[kFrameClasses] = {"rts",     "cts",    "ack",       "broadcast",
                                                      "unicast", "beacon", "management"};
  return kNames[static_cast<int>(kind)];
}

inline std::string_view class_of(const radio::Frame& frame) { return name(frame_class(frame)); }

}  // namespace sim::record
