#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/time.h"

namespace hal {

/// The QoS policies of a DDS writer or reader that decide what is on the air (OMG DDS 1.4, 2.2.3).
struct TopicQos {
  enum class Reliability : std::uint8_t { kBestEffort, kReliable };
  enum class Durability : std::uint8_t { kVolatile, kTransientLocal };
  Reliability reliability = Reliability::kReliable;
  Durability durability = Durability::kVolatile;
  /// HISTORY, KEEP_LAST: samples that are kept; nullopt: KEEP_ALL.
  std::optional<std::uint32_t> depth = 10;
  std::optional<Duration> deadline{};  ///< nullopt: none.
  bool operator==(const TopicQos&) const = default;
};

}  // namespace hal
