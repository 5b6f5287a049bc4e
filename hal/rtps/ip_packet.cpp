#include "hal/rtps/ip_packet.h"

#include <algorithm>

namespace hal::rtps {
namespace {

constexpr std::size_t kIpv6Header = 40;
constexpr std::uint16_t kMoreFragments = 0x2000, kOffsetMask = 0x1fff;

void read_address(Octets octets, IpAddress& address) {
  std::ranges::transform(octets, address.end() - static_cast<std::ptrdiff_t>(octets.size()),
                         [](std::byte octet) { return std::to_integer<std::uint8_t>(octet); });
}

/// Parses an IPv4 packet: RFC 791, 3.1.
std::optional<IpPacket> read_ipv4(Octets packet) {
  Cursor cursor(packet, Endianness::kBig);
  const std::uint8_t first = cursor.u8();
  const std::size_t header = std::size_t{first & 0xfU} * 4;
  cursor.take(1);  // type of service
  const std::size_t length = cursor.u16();
  IpPacket ip;
  ip.key.identification = cursor.u16();
  const std::uint16_t fragment = cursor.u16();
  ip.offset = (fragment & kOffsetMask) * 8U;
  ip.more = (fragment & kMoreFragments) != 0;
  cursor.take(1);  // time to live
  ip.key.protocol = cursor.u8();
  cursor.take(2);  // checksum: may be left to offloading
  read_address(cursor.take(4), ip.key.source);
  read_address(cursor.take(4), ip.key.destination);
  if (cursor.is_short() || first >> 4U != 4 || header < cursor.position()) return std::nullopt;
  if (length < header || length > packet.size()) return std::nullopt;
  ip.payload = packet.subspan(header, length - header);
  return ip;
}

/// Parses one IPv6 extension header (RFC 8200, 4). @return its length; 0 if there is none.
std::size_t read_extension(Octets rest, IpPacket& ip) {
  Cursor cursor(rest, Endianness::kBig);
  const std::uint8_t next = cursor.u8();
  const std::size_t length = std::size_t{cursor.u8() + 1U} * 8;
  switch (ip.key.protocol) {
    case protocol::kHopByHop:
    case protocol::kRouting:
    case protocol::kDestination:
      ip.key.protocol = next;
      return length;
    case protocol::kFragment: {
      const std::uint16_t fragment = cursor.u16();
      ip.offset = fragment & ~7U;
      ip.more = (fragment & 1U) != 0;
      ip.key.identification = cursor.u32();
      ip.key.protocol = next;
      return 8;
    }
    default:
      return 0;
  }
}

std::optional<IpPacket> read_ipv6(Octets packet) {
  Cursor cursor(packet, Endianness::kBig);
  const bool is_six = cursor.u32() >> 28U == 6;
  const std::size_t length = cursor.u16();
  IpPacket ip;
  ip.key.protocol = cursor.u8();
  cursor.take(1);  // hop limit
  read_address(cursor.take(16), ip.key.source);
  read_address(cursor.take(16), ip.key.destination);
  if (cursor.is_short() || !is_six || length > packet.size() - kIpv6Header) return std::nullopt;
  Octets rest = packet.subspan(kIpv6Header, length);
  // In fragments after the first, no extension headers follow the fragment header.
  while (ip.offset == 0) {
    const std::size_t extension = read_extension(rest, ip);
    if (extension == 0) break;
    if (extension > rest.size()) return std::nullopt;
    rest = rest.subspan(extension);
  }
  ip.payload = rest;
  return ip;
}

}  // namespace

std::optional<IpPacket> read_ip(std::uint16_t type, Octets packet) {
  if (type == kEthertypeIpv4) return read_ipv4(packet);
  if (type == kEthertypeIpv6) return read_ipv6(packet);
  return std::nullopt;
}

}  // namespace hal::rtps
