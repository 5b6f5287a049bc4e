#pragma once

#include <cstdint>

namespace sim::radio {

/// What the members of a BSS protect their HT, VHT and HE frames from: the HT Protection field of
/// the HT Operation element (IEEE Std 802.11-2020, 9.4.2.56 and 10.27.3.1), with its values.
enum class HtProtection : std::uint8_t {
  kNone = 0,       ///< All know HT and have the width of the BSS.
  kNonmember = 1,  ///< There are stations without HT, which are no members.
  k20Mhz = 2,      ///< All know HT, the BSS has 40 MHz or more, and some members only 20 MHz.
  kNonHtMixed = 3,
};

/// What the field depends on.
struct HtSurroundings {
  bool non_ht_members = false;
  bool non_ht_others = false;  ///< Stations without HT on the channel that are no members.
  bool narrow_members = false;
  std::uint16_t width = 20;  ///< Of the BSS, MHz.
};

constexpr HtProtection ht_protection(const HtSurroundings& around) {
  if (around.non_ht_members) return HtProtection::kNonHtMixed;
  if (around.non_ht_others) return HtProtection::kNonmember;
  constexpr std::uint16_t kNarrow = 20;
  const bool has_both = around.narrow_members && around.width > kNarrow;
  return has_both ? HtProtection::k20Mhz : HtProtection::kNone;
}

/// The protection fields of an HT Operation element.
struct HtOperation {
  HtProtection protection = HtProtection::kNone;
  bool non_greenfield = false;  ///< Members that do not know the greenfield format: all with HT.
  bool obss_non_ht = false;     ///< Stations without HT that are no members.
  bool operator==(const HtOperation&) const = default;
};

}  // namespace sim::radio
