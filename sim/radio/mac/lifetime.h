#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/time.h"
#include "sim/radio/mac/access_category.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// How long MSDUs of an access category may wait and be repeated (dot11EDCATableMSDULifetime), if
/// not as long as all others; nullopt: for ever.
inline std::optional<hal::Duration> lifetime_of(const DcfConfig& config, AccessCategory category) {
  if (!config.qos) return config.msdu_lifetime;
  const std::optional<hal::Duration>& own = config.edca.of(category).msdu_lifetime;
  return own ? own : config.msdu_lifetime;
}
/// The same of a user priority.
inline std::optional<hal::Duration> lifetime_of(const DcfConfig& config, std::uint8_t priority) {
  return lifetime_of(config, category_of(priority));
}

}  // namespace sim::radio
