#pragma once

#include <cstdint>
#include <string_view>

namespace sim::air {

/// Why a frame from an interface does not go on the air.
enum class Refusal : std::uint8_t {
  kTooShort,     ///< No Ethernet header.
  kTooLong,      ///< More behind the header than an MSDU holds.
  kEthertype,    ///< Neither IPv4, ARP nor IPv6.
  kSource,       ///< Not from this agent's address: a station sends under no other.
  kDestination,  ///< No station's address, and no group's; or this agent's own.
};
inline constexpr int kRefusals = 5;

constexpr std::string_view name(Refusal refusal) {
  constexpr std::string_view kNames[kRefusals] = {"too short", "too long", "ethertype", "source",
                                                  "destination"};
  return kNames[static_cast<int>(refusal)];
}
static_assert(name(Refusal::kDestination) == "destination");

}  // namespace sim::air
