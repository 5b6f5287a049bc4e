#pragma once

#include <cstddef>
#include <string>

#include "sim/air/ip_packet.h"

namespace sim::air {

/// Protocols of a program's packet and their ports, for people: "ARP", "IPv4 UDP 40000 > 5000",
/// "IPv6 UDP 7412 > 7410, RTPS", "IPv4 TCP 40001 > 80", "IPv6 ICMPv6", "IPv4 UDP, fragment" (not
/// the first one), "IPv4, malformed", "0x88b5" (another Ethertype). UDP is RTPS if its payload
/// begins with that protocol's magic number.
/// @param packet  after the Ethernet header.
std::string packet_text(radio::Ethertype type, Octets packet);

/// The same for a whole Ethernet II frame, without preamble and check sequence. "too short": it has
/// no whole header.
std::string ethernet_text(Octets frame);

/// Where an octet of an Ethernet II frame is, for people: "Ethernet header", "IPv4 header",
/// "UDP header", "UDP payload, byte 12", "ARP, byte 3", "padding".
/// @param at  index of the octet, less than the size of the frame.
std::string place_text(Octets frame, std::size_t at);

}  // namespace sim::air
