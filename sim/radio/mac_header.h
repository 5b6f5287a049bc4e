#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Type and subtype of a frame (IEEE Std 802.11-2016, table 9-1).
enum class FrameType : std::uint8_t {
  kData,
  kRts,
  kCts,
  kAck,
  kBeacon,  ///< This and the following: management frames of a BSS (bss_mac.h).
  kAuthentication,
  kDeauthentication,
  kAssociationRequest,
  kAssociationResponse,
  kReassociationRequest,
  kReassociationResponse,
  kDisassociation,
};
inline constexpr int kFrameTypes = 12;

/// "data", "rts", …
constexpr std::string_view name(FrameType type) {
  constexpr std::string_view kNames[kFrameTypes] = {"data",
                                                    "rts",
                                                    "cts",
                                                    "ack",
                                                    "beacon",
                                                    "authentication",
                                                    "deauthentication",
                                                    "association request",
                                                    "association response",
                                                    "reassociation request",
                                                    "reassociation response",
                                                    "disassociation"};
  return kNames[static_cast<int>(type)];
}
static_assert(name(FrameType::kDisassociation) == "disassociation");

constexpr bool is_management(FrameType type) { return type >= FrameType::kBeacon; }
constexpr bool is_control(FrameType type) {
  return type == FrameType::kRts || type == FrameType::kCts || type == FrameType::kAck;
}

/// To DS and From DS of a data frame: no distribution system in an ad hoc network; into it, from a
/// station to its access point; out of it, from an access point.
enum class Ds : std::uint8_t { kNone, kTo, kFrom };

/// What the header of a data or management frame says beyond transmitter and receiver.
struct MacHeader {
  FrameType type = FrameType::kData;
  Ds ds = Ds::kNone;
  /// The third address (tables 9-26 and 9.3.3.2): the destination To DS, the source From DS, else
  /// the BSSID, which in an ad hoc network is that of agent 0.
  hal::AgentId address3{};
  /// When a layer above the DCF took the request; none: the DCF has it from the client.
  std::optional<hal::Time> since{};
};

}  // namespace sim::radio
