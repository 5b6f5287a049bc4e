#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/types/agent_id.h"
#include "hal/types/enum_names.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Type and subtype of a frame (IEEE Std 802.11-2016, table 9-1). Fingerprints depend on the
/// numbers.
enum class FrameType : std::uint8_t {
  kData,
  kRts,
  kCts,
  kAck,
  kBeacon,  ///< This and the following are management frames of a BSS (bss_mac.h).
  kAuthentication,
  kDeauthentication,
  kAssociationRequest,
  kAssociationResponse,
  kReassociationRequest,
  kReassociationResponse,
  kDisassociation,
  kBlockAckRequest,
  kBlockAck,
  kAction,  ///< Management: action frame (block_ack_action.h).
};
inline constexpr int kFrameTypes = 15;

/// "data", "rts", …
constexpr std::string_view name(FrameType type) {
  switch (type) {
    case FrameType::kData:
      return "data";
    case FrameType::kRts:
      return "rts";
    case FrameType::kCts:
      return "cts";
    case FrameType::kAck:
      return "ack";
    case FrameType::kBeacon:
      return "beacon";
    case FrameType::kAuthentication:
      return "authentication";
    case FrameType::kDeauthentication:
      return "deauthentication";
    case FrameType::kAssociationRequest:
      return "association request";
    case FrameType::kAssociationResponse:
      return "association response";
    case FrameType::kReassociationRequest:
      return "reassociation request";
    case FrameType::kReassociationResponse:
      return "reassociation response";
    case FrameType::kDisassociation:
      return "disassociation";
    case FrameType::kBlockAckRequest:
      return "block ack request";
    case FrameType::kBlockAck:
      return "block ack";
    case FrameType::kAction:
      return "action";
  }
  return {};
}
static_assert(hal::names_exactly<FrameType, kFrameTypes>([](FrameType t) { return name(t); }));

constexpr bool is_control(FrameType type) {
  switch (type) {
    case FrameType::kRts:
    case FrameType::kCts:
    case FrameType::kAck:
    case FrameType::kBlockAckRequest:
    case FrameType::kBlockAck:
      return true;
    default:
      return false;
  }
}
constexpr bool is_management(FrameType type) {
  return type != FrameType::kData && !is_control(type);
}

/// To DS and From DS of a data frame. kNone: ad hoc network, no distribution system. kTo: from a
/// station to its access point. kFrom: from an access point to a station.
enum class Ds : std::uint8_t { kNone, kTo, kFrom };

/// Fields of the header of a data or management frame besides transmitter and receiver.
struct MacHeader {
  FrameType type = FrameType::kData;
  Ds ds = Ds::kNone;
  /// The third address (tables 9-26 and 9.3.3.2): the destination if To DS, the source if From DS,
  /// else the BSSID, which in an ad hoc network is the address of agent 0.
  hal::AgentId address3{};
  /// When a layer above the DCF accepted the request; nullopt: it comes straight from the client.
  std::optional<hal::Time> since{};
  std::uint64_t ticket = 0;  ///< Of the layer above the DCF, which gets it back.
};

}  // namespace sim::radio
