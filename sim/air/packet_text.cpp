#include "sim/air/packet_text.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <optional>
#include <string_view>

#include "sim/air/air_kind.h"
#include "sim/radio/mac/mac_address.h"

namespace sim::air {
namespace {

using hal::rtps::Cursor;
using hal::rtps::Endianness;

constexpr std::size_t kAddresses = 2 * radio::kAddressSize, kEthernetHeader = kAddresses + 2;
constexpr std::size_t kHeaderOfUdp = 8;  // RFC 768

std::string_view version_of(radio::Ethertype type) {
  return type == kEthertypeIpv4 ? "IPv4" : "IPv6";
}

std::string protocol_of(const IpPacket& packet) {
  return what_text({.purpose = Purpose::kNetwork, .what = packet.key.protocol});
}

bool has_ports(const IpPacket& packet) {
  return packet.key.protocol == protocol::kUdp || packet.key.protocol == protocol::kTcp;
}

/// OMG DDSI-RTPS 2.5, 9.4.4: each message begins with these octets.
bool is_rtps(const IpPacket& packet) {
  constexpr std::array<char, 4> kMagic{'R', 'T', 'P', 'S'};
  return packet.key.protocol == protocol::kUdp &&
         packet.payload.size() >= kHeaderOfUdp + kMagic.size() &&
         std::memcmp(packet.payload.data() + kHeaderOfUdp, kMagic.data(), kMagic.size()) == 0;
}

std::string ip_text(radio::Ethertype type, const IpPacket& packet) {
  std::string text = fmt::format("{} {}", version_of(type), protocol_of(packet));
  if (packet.offset > 0) return text + ", fragment";
  Cursor cursor(packet.payload, Endianness::kBig);
  const std::uint16_t from = cursor.u16(), to = cursor.u16();
  if (has_ports(packet) && !cursor.is_short()) text += fmt::format(" {} > {}", from, to);
  return text + (is_rtps(packet) ? ", RTPS" : "");
}

std::optional<radio::Ethertype> ethertype_of(Octets frame) {
  if (frame.size() < kEthernetHeader) return std::nullopt;
  return Cursor(frame.subspan(kAddresses), Endianness::kBig).u16();
}

/// Place within an IP packet. @param at  index of the octet after the Ethernet header.
std::string place_in(radio::Ethertype type, Octets packet, std::size_t at) {
  const std::optional<IpPacket> ip = read_ip(type, packet);
  if (!ip) return fmt::format("{}, byte {}", version_of(type), at);
  const auto begin = static_cast<std::size_t>(ip->payload.data() - packet.data());
  if (at < begin) return fmt::format("{} header", version_of(type));
  if (at >= begin + ip->payload.size()) return "padding";
  const std::string protocol = protocol_of(*ip);
  const bool has_header = ip->key.protocol == protocol::kUdp && ip->offset == 0;
  const std::size_t header = has_header ? kHeaderOfUdp : 0;
  if (at < begin + header) return protocol + " header";
  return fmt::format("{}{}, byte {}", protocol, has_header ? " payload" : "", at - begin - header);
}

}  // namespace

std::string packet_text(radio::Ethertype type, Octets packet) {
  if (type == kEthertypeArp) return "ARP";
  if (type != kEthertypeIpv4 && type != kEthertypeIpv6) return fmt::format("0x{:04x}", type);
  const std::optional<IpPacket> ip = read_ip(type, packet);
  return ip ? ip_text(type, *ip) : fmt::format("{}, malformed", version_of(type));
}

std::string ethernet_text(Octets frame) {
  const auto type = ethertype_of(frame);
  return type ? packet_text(*type, frame.subspan(kEthernetHeader)) : "too short";
}

std::string place_text(Octets frame, std::size_t at) {
  const auto type = ethertype_of(frame);
  if (!type || at < kEthernetHeader) return "Ethernet header";
  const std::size_t inside = at - kEthernetHeader;
  if (*type == kEthertypeIpv4 || *type == kEthertypeIpv6)
    return place_in(*type, frame.subspan(kEthernetHeader), inside);
  return fmt::format("{}, byte {}", packet_text(*type, {}), inside);
}

}  // namespace sim::air
