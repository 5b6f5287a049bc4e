#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>

#include "hal/rtps/cursor.h"

namespace hal::rtps {

/// Ethertypes (IANA, "IEEE 802 Numbers").
inline constexpr std::uint16_t kEthertypeIpv4 = 0x0800, kEthertypeIpv6 = 0x86dd;

/// Protocol numbers that are interpreted (IANA, "Assigned Internet Protocol Numbers").
namespace protocol {
inline constexpr std::uint8_t kHopByHop = 0, kIcmp = 1, kIgmp = 2, kTcp = 6, kUdp = 17,
                              kRouting = 43, kFragment = 44, kIcmpv6 = 58, kDestination = 60;
}  // namespace protocol

/// An IPv6 address, or an IPv4 one in the last four octets.
using IpAddress = std::array<std::uint8_t, 16>;

/// Identifies the fragments of one datagram (RFC 791, 2.3; RFC 8200, 4.5).
struct FragmentKey {
  IpAddress source{}, destination{};
  std::uint32_t identification = 0;
  std::uint8_t protocol = 0;  ///< Protocol of the payload, after any IPv6 extension headers.
  auto operator<=>(const FragmentKey&) const = default;
};

/// One IPv4 or IPv6 packet, of those that carry RTPS, without its Ethernet header.
struct IpPacket {
  FragmentKey key;
  std::uint32_t offset = 0;  ///< Offset of the payload in that of the whole datagram, octets.
  bool more = false;         ///< Fragments follow.
  Octets payload;            ///< Without IP headers.

  bool is_fragment() const { return more || offset > 0; }
};

/// @param packet  after the Ethernet header; octets beyond the packet's own length are padding.
/// @return nullopt if it is neither IPv4 nor IPv6, or truncated.
std::optional<IpPacket> read_ip(std::uint16_t type, Octets packet);

}  // namespace hal::rtps
