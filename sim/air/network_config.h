#pragma once

#include <cstdint>

namespace sim::air {

inline constexpr int kLeastPrefix = 8, kMostPrefix = 30;
/// Bytes of an IP packet: what every host accepts in one piece (RFC 791), and what fits into a
/// frame after LLC and SNAP.
inline constexpr int kLeastMtu = 576, kMostMtu = 2296;
inline constexpr int kLeastMtuOfIpv6 = 1280;  ///< RFC 8200, 5: below it there is no IPv6.

/// The interface `wlan0` of an agent, by which programs with sockets use its simulated radio.
struct NetworkConfig {
  std::uint32_t address = 0;  ///< IPv4, host order.
  int prefix = 16;            ///< Bits of the address that name the network.
  int mtu = 1500;             ///< Bytes of an IP packet.
  bool operator==(const NetworkConfig&) const = default;
};

}  // namespace sim::air
