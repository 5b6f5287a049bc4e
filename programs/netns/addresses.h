#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace programs::netns {

using Ipv6 = std::array<std::uint8_t, 16>;

/// MAC address of an agent, 02:00:00:00:hh:ll: locally administered (IEEE Std 802-2014, 8.2.2).
constexpr std::array<std::uint8_t, 6> mac_address(std::uint16_t id) {
  return {2, 0, 0, 0, static_cast<std::uint8_t>(id >> 8), static_cast<std::uint8_t>(id)};
}

/// The IPv6 address that the kernel derives from that MAC address, fe80::ff:fe00:hhll: prefix and
/// modified EUI-64 (RFC 4291, appendix A).
constexpr Ipv6 link_local_address(std::uint16_t id) {
  return {0xfe,
          0x80,
          0,
          0,
          0,
          0,
          0,
          0,
          0,
          0,
          0,
          0xff,
          0xfe,
          0,
          static_cast<std::uint8_t>(id >> 8),
          static_cast<std::uint8_t>(id)};
}

/// Unique local address of an agent (RFC 4193), fd00:ba4a:4a::ff:fe00:hhll. Names resolve to it,
/// because a link-local address needs an interface, which /etc/hosts cannot give. It has the same
/// last bits as the link-local address, hence the same solicited-node group, and causes no further
/// frames.
constexpr Ipv6 unique_local_address(std::uint16_t id) {
  Ipv6 address = link_local_address(id);
  address[0] = 0xfd;
  address[1] = 0x00;
  address[2] = 0xba;
  address[3] = address[5] = 0x4a;
  return address;
}
inline constexpr unsigned kUniqueLocalPrefix = 64;

std::string to_text(const Ipv6& address);
/// @param address  IPv4, host byte order.
std::string to_text(std::uint32_t address);

}  // namespace programs::netns
