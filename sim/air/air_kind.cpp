#include "sim/air/air_kind.h"

#include <fmt/format.h>

#include "hal/rtps/submessage.h"
#include "sim/air/ip_packet.h"
#include "sim/radio/mac/mac_header.h"

namespace sim::air {
namespace {

std::string submessage_text(std::uint16_t what) {
  if (what == kMalformed) return "malformed";
  const std::string_view known = hal::rtps::name_of(static_cast<hal::rtps::SubmessageKind>(what));
  if (known == "vendor's") return fmt::format("vendor 0x{:02x}", what);
  return known == "unknown" ? fmt::format("unknown 0x{:02x}", what) : std::string(known);
}

std::string protocol_text(std::uint16_t what) {
  switch (what) {
    case kArp:
      return "ARP";
    case kFragments:
      return "fragments";
    case kMalformed:
      return "malformed";
    case protocol::kIcmp:
      return "ICMP";
    case protocol::kIgmp:
      return "IGMP";
    case protocol::kTcp:
      return "TCP";
    case protocol::kUdp:
      return "UDP";
    case protocol::kIcmpv6:
      return "ICMPv6";
    default:
      return fmt::format("IP {}", what);
  }
}

}  // namespace

std::string what_text(const AirKind& kind) {
  if (is_rtps(kind.purpose)) return submessage_text(kind.what);
  if (kind.purpose == Purpose::kNetwork) return protocol_text(kind.what);
  if (kind.purpose == Purpose::kMac)
    return std::string(radio::name(static_cast<radio::FrameType>(kind.what)));
  return fmt::format("0x{:04x}", kind.what);
}

}  // namespace sim::air
