#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/time.h"

namespace hal {

/// The QoS policies of a DDS writer or reader that decide what is on the air (OMG DDS 1.4, 2.2.3).
struct TopicQos {
  /// RELIABILITY: whether lost samples are sent again.
  enum class Reliability : std::uint8_t { kBestEffort, kReliable };
  /// DURABILITY: whether late readers get the samples in the writer's history.
  enum class Durability : std::uint8_t { kVolatile, kTransientLocal };
  Reliability reliability = Reliability::kReliable;  ///< A writer's default.
  Durability durability = Durability::kVolatile;     ///< The default of both.
  /// HISTORY, KEEP_LAST: samples that are kept; nullopt: KEEP_ALL.
  std::optional<std::uint32_t> depth = 10;
  std::optional<Duration> deadline{};  ///< nullopt: none.
  /// Whether all policies are equal.
  bool operator==(const TopicQos&) const = default;
};

}  // namespace hal
