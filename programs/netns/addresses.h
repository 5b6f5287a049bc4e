#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace programs::netns {

using Ipv6 = std::array<std::uint8_t, 16>;

/// 02:00:00:00:hh:ll: locally administered (IEEE Std 802-2014, 8.2.2).
constexpr std::array<std::uint8_t, 6> mac_address(std::uint16_t id) {
  return {2, 0, 0, 0, static_cast<std::uint8_t>(id >> 8), static_cast<std::uint8_t>(id)};
}

/// What the kernel makes of that MAC address: the prefix and its modified EUI-64 (RFC 4291,
/// appendix A): fe80::ff:fe00:hhll.
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

/// fd00:ba4a:4a::ff:fe00:hhll, a unique local address (RFC 4193): /etc/hosts cannot name the
/// interface that a link-local one needs, so names resolve to this one. It ends as the link-local
/// one, hence is of the same solicited-node group and causes no further frame.
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
/// @param address  IPv4, host order.
std::string to_text(std::uint32_t address);

}  // namespace programs::netns
