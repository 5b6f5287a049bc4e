#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "hal/types/enum_names.h"

namespace sim::air {

/// Purpose of a part of a frame.
enum class Purpose : std::uint8_t {
  kUser,        ///< RTPS: data of the writers and readers of programs.
  kSpdp,        ///< RTPS: discovery of participants.
  kSedp,        ///< RTPS: discovery of endpoints.
  kLiveliness,  ///< RTPS: participant messages.
  kBuiltin,     ///< RTPS: other endpoints of the middleware: security, type lookup, a vendor's.
  kRtps,        ///< RTPS without endpoints: nothing else is in the datagram.
  kNetwork,     ///< IP and ARP other than RTPS.
  kRouting,     ///< Frames of hal/node/routing.
  kMac,         ///< Control and management of IEEE 802.11.
  kOther,
};
inline constexpr int kPurposes = 10;

constexpr std::string_view name(Purpose purpose) {
  switch (purpose) {
    case Purpose::kUser:
      return "user";
    case Purpose::kSpdp:
      return "SPDP";
    case Purpose::kSedp:
      return "SEDP";
    case Purpose::kLiveliness:
      return "liveliness";
    case Purpose::kBuiltin:
      return "builtin";
    case Purpose::kRtps:
      return "RTPS";
    case Purpose::kNetwork:
      return "network";
    case Purpose::kRouting:
      return "routing";
    case Purpose::kMac:
      return "802.11";
    case Purpose::kOther:
      return "other";
  }
  return {};
}
static_assert(hal::names_exactly<Purpose, kPurposes>([](Purpose p) { return name(p); }));

constexpr bool is_rtps(Purpose purpose) { return purpose <= Purpose::kRtps; }

/// Account of a part of a frame.
struct AirKind {
  Purpose purpose = Purpose::kOther;
  /// Of RTPS the kind of submessage; of kNetwork the number of the protocol, of ARP kArp; of kMac a
  /// radio::FrameType; else the Ethertype.
  std::uint16_t what = 0;
  std::uint16_t port = 0;   ///< Of TCP and UDP that is no RTPS, see service_port(); 0: none.
  std::uint32_t topic = 0;  ///< Of kUser: number among Endpoints::topics(); 0: not known.
  auto operator<=>(const AirKind&) const = default;
};

inline constexpr std::uint16_t kArp = 0x100;
/// Fragments of IP of which nobody saw the first, so that nobody knows what they are of.
inline constexpr std::uint16_t kFragments = 0x101;
/// What cannot be walked over as RTPS, or as IP.
inline constexpr std::uint16_t kMalformed = 0x102;

/// The port that identifies the service: the lower one. 0 if both are ephemeral ports (from 32768
/// on, as in Linux), which are too many to be distinguished.
constexpr std::uint16_t service_port(std::uint16_t one, std::uint16_t other) {
  const std::uint16_t lower = one < other ? one : other;
  return lower < 32768 ? lower : 0;
}

/// "DATA", "vendor 0x80", "ARP", "UDP", "IP 132", "ack", "0x88b5".
std::string what_text(const AirKind& kind);

}  // namespace sim::air
