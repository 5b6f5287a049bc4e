#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/types/enum_names.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Access categories of EDCA (IEEE Std 802.11-2020, 10.2.3.2), in ascending order of priority:
/// background, best effort, video, voice.
enum class AccessCategory : std::uint8_t { kBackground, kBestEffort, kVideo, kVoice };
inline constexpr std::size_t kAccessCategories = 4;

/// "BK", "BE", "VI", "VO".
constexpr std::string_view name(AccessCategory category) {
  switch (category) {
    case AccessCategory::kBackground:
      return "BK";
    case AccessCategory::kBestEffort:
      return "BE";
    case AccessCategory::kVideo:
      return "VI";
    case AccessCategory::kVoice:
      return "VO";
  }
  return {};
}
static_assert(hal::names_exactly<AccessCategory, static_cast<int>(kAccessCategories)>(
    [](AccessCategory c) { return name(c); }));

/// How one access category contends for the medium.
struct AccessParameters {
  std::uint32_t cw_min = 15;    ///< Slots; one less than a power of two.
  std::uint32_t cw_max = 1023;  ///< Slots; one less than a power of two, >= cw_min.
  std::uint32_t aifsn = 3;  ///< AIFS = SIFS + aifsn slots; 2 .. 15 (1 .. 15 in an access point).
  /// Longest time for which a station may hold the medium; 0: one frame exchange.
  hal::Duration txop_limit{};
  /// Lifetime of MSDUs, instead of that of all categories, > 0.
  std::optional<hal::Duration> msdu_lifetime{};
  bool operator==(const AccessParameters&) const = default;
};

/// Enhanced distributed channel access (10.23.2).
struct EdcaConfig {
  std::array<AccessParameters, kAccessCategories> categories{};

  AccessParameters& of(AccessCategory category) {
    return categories[static_cast<std::size_t>(category)];
  }
  const AccessParameters& of(AccessCategory category) const {
    return categories[static_cast<std::size_t>(category)];
  }
  bool operator==(const EdcaConfig&) const = default;
};

/// The defaults of IEEE Std 802.11-2020, table 9-155, from the PHY's windows: background and best
/// effort have them whole, video half of cw_min, voice a quarter.
/// @param cw_min,cw_max  aCWmin and aCWmax: 31 and 1023 of DSSS, else 15 and 1023.
/// @param is_dsss  the TXOP limits of clauses 15 and 16 rather than those of OFDM, HT, VHT and HE.
constexpr EdcaConfig edca_defaults(std::uint32_t cw_min, std::uint32_t cw_max, bool is_dsss) {
  using std::chrono::microseconds;
  const std::uint32_t half = (cw_min + 1) / 2 - 1, quarter = (cw_min + 1) / 4 - 1;
  const hal::Duration video = microseconds{is_dsss ? 6016 : 4096};
  const hal::Duration voice = microseconds{is_dsss ? 3264 : 2080};
  return {{{{cw_min, cw_max, 7, {}, {}},
            {cw_min, cw_max, 3, {}, {}},
            {half, cw_min, 2, video, {}},
            {quarter, half, 2, voice, {}}}}};
}

}  // namespace sim::radio
