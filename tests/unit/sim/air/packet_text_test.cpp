#include "sim/air/packet_text.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace sim::air {
namespace {

using Bytes = std::vector<std::uint8_t>;

Octets octets(const Bytes& bytes) { return std::as_bytes(std::span(bytes)); }

/// RFC 791, 3.1: 20 octets of header, no options.
Bytes ipv4(std::uint8_t protocol, const Bytes& payload, std::uint16_t fragment = 0) {
  Bytes packet{0x45,
               0,
               0,
               static_cast<std::uint8_t>(20 + payload.size()),
               0,
               1,
               static_cast<std::uint8_t>(fragment >> 8),
               static_cast<std::uint8_t>(fragment & 0xff)};
  packet.insert(packet.end(), {64, protocol, 0, 0, 10, 77, 0, 1, 10, 77, 0, 2});
  packet.insert(packet.end(), payload.begin(), payload.end());
  return packet;
}

/// RFC 8200, 3.
Bytes ipv6(std::uint8_t next, const Bytes& payload) {
  Bytes packet{0x60, 0, 0, 0, 0, static_cast<std::uint8_t>(payload.size()), next, 64};
  packet.resize(40);
  packet.insert(packet.end(), payload.begin(), payload.end());
  return packet;
}

/// Ports and a payload, as UDP (RFC 768).
Bytes udp(std::uint16_t from, std::uint16_t to, std::string_view payload) {
  Bytes datagram{static_cast<std::uint8_t>(from >> 8),
                 static_cast<std::uint8_t>(from & 0xff),
                 static_cast<std::uint8_t>(to >> 8),
                 static_cast<std::uint8_t>(to & 0xff),
                 0,
                 static_cast<std::uint8_t>(8 + payload.size())};
  datagram.resize(8);
  datagram.insert(datagram.end(), payload.begin(), payload.end());
  return datagram;
}

Bytes ethernet(std::uint16_t type, const Bytes& packet) {
  Bytes frame(12, 2);
  frame.push_back(static_cast<std::uint8_t>(type >> 8));
  frame.push_back(static_cast<std::uint8_t>(type & 0xff));
  frame.insert(frame.end(), packet.begin(), packet.end());
  return frame;
}

std::string text(std::uint16_t type, const Bytes& packet) {
  EXPECT_EQ(ethernet_text(octets(ethernet(type, packet))), packet_text(type, octets(packet)));
  return packet_text(type, octets(packet));
}

TEST(PacketText, NamesProtocolsAndPorts) {
  EXPECT_EQ(text(kEthertypeArp, Bytes(28)), "ARP");
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kUdp, udp(40000, 5000, "x"))),
            "IPv4 UDP 40000 > 5000");
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kTcp, Bytes{0x9c, 0x41, 0, 80, 0, 0})),
            "IPv4 TCP 40001 > 80");
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kIcmp, Bytes{8, 0, 0, 0})), "IPv4 ICMP");
  EXPECT_EQ(text(kEthertypeIpv6, ipv6(protocol::kIcmpv6, Bytes{128, 0, 0, 0})), "IPv6 ICMPv6");
  EXPECT_EQ(text(kEthertypeIpv6, ipv6(protocol::kUdp, udp(7412, 7410, "RTPS\x02\x03"))),
            "IPv6 UDP 7412 > 7410, RTPS");
  EXPECT_EQ(text(0x88b5, Bytes{1}), "0x88b5");
}

TEST(PacketText, RtpsIsKnownByItsMagicNumberOnly) {
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kUdp, udp(1, 2, "RTPS"))), "IPv4 UDP 1 > 2, RTPS");
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kUdp, udp(7400, 7400, "RTP"))),
            "IPv4 UDP 7400 > 7400");
}

TEST(PacketText, FragmentsAndDamageAreNamed) {
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kUdp, udp(1, 2, "x"), 5)), "IPv4 UDP, fragment");
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kUdp, udp(1, 2, "x"), 0x2000)), "IPv4 UDP 1 > 2");
  EXPECT_EQ(text(kEthertypeIpv4, Bytes{0x45}), "IPv4, malformed");
  EXPECT_EQ(text(kEthertypeIpv6, Bytes(39)), "IPv6, malformed");
  EXPECT_EQ(text(kEthertypeIpv4, ipv4(protocol::kUdp, Bytes{1, 2, 3})), "IPv4 UDP");
  EXPECT_EQ(ethernet_text(octets(Bytes(13))), "too short");
}

TEST(PlaceText, NamesTheHeaderOrTheByte) {
  Bytes frame = ethernet(kEthertypeIpv4, ipv4(protocol::kUdp, udp(1, 2, "ab")));
  frame.push_back(0);
  const auto place = [&](std::size_t at) { return place_text(octets(frame), at); };
  EXPECT_EQ(place(0), "Ethernet header");
  EXPECT_EQ(place(13), "Ethernet header");
  EXPECT_EQ(place(14), "IPv4 header");
  EXPECT_EQ(place(33), "IPv4 header");
  EXPECT_EQ(place(34), "UDP header");
  EXPECT_EQ(place(42), "UDP payload, byte 0");
  EXPECT_EQ(place(43), "UDP payload, byte 1");
  EXPECT_EQ(place(44), "padding");
  const auto of = [](std::uint16_t type, const Bytes& packet, std::size_t at) {
    return place_text(octets(ethernet(type, packet)), at);
  };
  EXPECT_EQ(of(kEthertypeIpv4, ipv4(protocol::kIcmp, Bytes{8, 0}), 35), "ICMP, byte 1");
  EXPECT_EQ(of(kEthertypeIpv6, ipv6(protocol::kUdp, udp(1, 2, "ab")), 62), "UDP payload, byte 0");
  EXPECT_EQ(of(kEthertypeIpv4, ipv4(protocol::kUdp, Bytes{1}, 5), 34), "UDP, byte 0");
  EXPECT_EQ(of(kEthertypeArp, Bytes(28), 17), "ARP, byte 3");
  EXPECT_EQ(of(kEthertypeIpv4, Bytes{0x45}, 14), "IPv4, byte 0");
}

}  // namespace
}  // namespace sim::air
