#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/radio/mac/edca_config.h"

namespace sim::radio {

/// Access category of a user priority (IEEE Std 802.11-2020, table 10-1): 1 and 2 are background, 0
/// and 3 best effort, 4 and 5 video, 6 and 7 voice.
constexpr AccessCategory category_of(std::uint8_t priority) {
  using enum AccessCategory;
  constexpr std::array kOfPriority{kBestEffort, kBackground, kBackground, kBestEffort,
                                   kVideo,      kVideo,      kVoice,      kVoice};
  return kOfPriority[priority % kOfPriority.size()];
}

}  // namespace sim::radio
