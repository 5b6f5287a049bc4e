#pragma once

#include <cstdint>

#include "hal/types/time.h"

namespace sim::radio {

enum class RateControlKind : std::uint8_t { kFixed, kAarf, kMinstrel };

/// How the rate of data frames is chosen, for each destination by itself.
struct RateControlConfig {
  RateControlKind kind = RateControlKind::kFixed;

  std::uint32_t aarf_threshold = 10;      ///< Successes in a row before a higher rate, >= 1.
  std::uint32_t aarf_max_threshold = 50;  ///< >= aarf_threshold.
  /// Transmissions at one rate before a higher one whatever became of them, >= 1; grows as the
  /// threshold does.
  std::uint32_t aarf_timeout = 15;

  hal::Duration minstrel_interval = std::chrono::milliseconds{100};  ///< > 0, of the statistics.
  double minstrel_past = 0.75;     ///< Weight of what was known before an interval, 0 .. < 1.
  double minstrel_sampling = 0.1;  ///< Share of frames that try another rate, 0 .. 1.
};

}  // namespace sim::radio
