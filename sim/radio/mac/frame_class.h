#pragma once

#include <cstdint>
#include <string_view>

#include "hal/types/enum_names.h"
#include "sim/radio/mac/frame.h"

namespace sim::radio {

/// Class of a frame, as in the tables of records.
enum class FrameClass : std::uint8_t {
  kRts,
  kCts,
  kAck,
  kBroadcast,
  kUnicast,
  kBeacon,
  kManagement,
  kBlockAck,  ///< BlockAck and BlockAckReq.
};
inline constexpr int kFrameClasses = 8;

inline FrameClass frame_class(const Frame& frame) {
  switch (frame.type) {
    case FrameType::kRts:
      return FrameClass::kRts;
    case FrameType::kCts:
      return FrameClass::kCts;
    case FrameType::kAck:
      return FrameClass::kAck;
    case FrameType::kBeacon:
      return FrameClass::kBeacon;
    case FrameType::kBlockAckRequest:
    case FrameType::kBlockAck:
      return FrameClass::kBlockAck;
    default:
      break;
  }
  if (is_management(frame.type)) return FrameClass::kManagement;
  return frame.is_broadcast() ? FrameClass::kBroadcast : FrameClass::kUnicast;
}

constexpr std::string_view name(FrameClass kind) {
  switch (kind) {
    case FrameClass::kRts:
      return "rts";
    case FrameClass::kCts:
      return "cts";
    case FrameClass::kAck:
      return "ack";
    case FrameClass::kBroadcast:
      return "broadcast";
    case FrameClass::kUnicast:
      return "unicast";
    case FrameClass::kBeacon:
      return "beacon";
    case FrameClass::kManagement:
      return "management";
    case FrameClass::kBlockAck:
      return "block_ack";
  }
  return {};
}
static_assert(hal::names_exactly<FrameClass, kFrameClasses>([](FrameClass c) { return name(c); }));

inline std::string_view class_of(const Frame& frame) { return name(frame_class(frame)); }

}  // namespace sim::radio
