#pragma once

#include <cstdint>

#include "hal/types/priority.h"
#include "sim/radio/mac/edca_config.h"

namespace sim::radio {

/// Access category of a user priority (IEEE Std 802.11-2020, table 10-1): 1 and 2 are background, 0
/// and 3 best effort, 4 and 5 video, 6 and 7 voice.
constexpr AccessCategory category_of(std::uint8_t priority) {
  return static_cast<AccessCategory>(hal::access_category(hal::Priority{priority}));
}

}  // namespace sim::radio
