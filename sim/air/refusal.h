#pragma once

#include <cstdint>
#include <string_view>

#include "hal/types/enum_names.h"

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
  switch (refusal) {
    case Refusal::kTooShort:
      return "too short";
    case Refusal::kTooLong:
      return "too long";
    case Refusal::kEthertype:
      return "ethertype";
    case Refusal::kSource:
      return "source";
    case Refusal::kDestination:
      return "destination";
  }
  return {};
}
static_assert(hal::names_exactly<Refusal, kRefusals>([](Refusal r) { return name(r); }));

}  // namespace sim::air
