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
  kBuiltin,     ///< RTPS: other built-in endpoints: security, type lookup, a vendor's own.
  kRtps,        ///< RTPS datagrams whose submessages all have no endpoint.
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

/// Kind of a part of a frame, for which an account is kept.
struct AirKind {
  Purpose purpose = Purpose::kOther;
  /// RTPS: kind of submessage. kNetwork: IP protocol number, or kArp. kMac: radio::FrameType. Else
  /// the Ethertype.
  std::uint16_t what = 0;
  std::uint16_t port = 0;   ///< TCP, and UDP other than RTPS: service_port(); 0: none.
  std::uint32_t topic = 0;  ///< kUser: index into Endpoints::topics(); 0: unknown.
  auto operator<=>(const AirKind&) const = default;
};

inline constexpr std::uint16_t kArp = 0x100;
/// IP fragments of a datagram whose first fragment was not observed, so its protocol data is
/// unknown.
inline constexpr std::uint16_t kFragments = 0x101;
/// Data that cannot be parsed as RTPS or as IP.
inline constexpr std::uint16_t kMalformed = 0x102;

/// Port that identifies the service: the lower one. 0 if both are ephemeral ports (from 32768 on,
/// as in Linux), of which there are too many to distinguish.
constexpr std::uint16_t service_port(std::uint16_t one, std::uint16_t other) {
  const std::uint16_t lower = one < other ? one : other;
  return lower < 32768 ? lower : 0;
}

/// "DATA", "vendor 0x80", "ARP", "UDP", "IP 132", "ack", "0x88b5".
std::string what_text(const AirKind& kind);

}  // namespace sim::air
