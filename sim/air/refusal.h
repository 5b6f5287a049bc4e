#pragma once

#include <cstdint>
#include <string_view>

#include "hal/types/enum_names.h"

namespace sim::air {

/// Why a frame from an interface is not sent.
enum class Refusal : std::uint8_t {
  kTooShort,     ///< No Ethernet header.
  kTooLong,      ///< Its payload exceeds an MSDU.
  kEthertype,    ///< Neither IPv4, ARP nor IPv6.
  kSource,       ///< Its source is not this agent's address.
  kDestination,  ///< Neither a station's address nor a group address, or this agent's own.
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
