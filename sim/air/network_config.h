#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::air {

inline constexpr int kLeastPrefix = 8, kMostPrefix = 30;
/// Limits of the MTU in bytes: what every host accepts in one piece (RFC 791), and what fits into a
/// frame after LLC and SNAP.
inline constexpr int kLeastMtu = 576, kMostMtu = 2296;
inline constexpr int kLeastMtuOfIpv6 = 1280;  ///< RFC 8200, 5: minimum MTU of IPv6.

/// What a program in lock-step does to the run if it waits in a call that lock-step does not know.
enum class UnknownWaits : std::uint8_t {
  kFail,
  kAllow,  ///< Nothing: simulated time goes on without it until the call ends.
};

/// A network of IP: the addresses that begin with the first `prefix` bits of `address`.
struct IpNetwork {
  bool is_ipv6 = false;
  int prefix = 0;  ///< 0..32 for IPv4, 0..128 for IPv6.
  std::array<std::uint8_t, 16>
      address{};  ///< Network byte order; IPv4: the first four. Later bits 0.
  auto operator<=>(const IpNetwork&) const = default;
};

/// A route of the kernel in an agent's namespace, besides the one to its own network.
struct IpRoute {
  hal::AgentId to{};  ///< Its IPv4 and IPv6 addresses; 0: to `network`.
  IpNetwork network{};
  hal::AgentId via{};  ///< The next hop, not the agent itself; `to`: directly.
  bool operator==(const IpRoute&) const = default;
};

/// The interface `wlan0` of an agent, through which programs with sockets use its simulated radio.
struct NetworkConfig {
  std::uint32_t address = 0;  ///< IPv4, host order.
  int prefix = 16;            ///< Length of the network prefix in bits.
  int mtu = 1500;             ///< Largest IP packet in bytes.
  UnknownWaits unknown_waits = UnknownWaits::kFail;
  /// In lock-step: how long a turn of a thread occupies the agent's processor, from 0 to 1 s.
  hal::Duration per_wake{0};
  std::vector<IpRoute> routes{};  ///< Each destination at most once.
  bool forwards = false;          ///< Packets of other agents, which have a route via this one.
  bool operator==(const NetworkConfig&) const = default;
};

}  // namespace sim::air
