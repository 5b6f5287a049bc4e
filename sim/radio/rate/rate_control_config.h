#pragma once

#include <cstdint>

#include "hal/types/time.h"

namespace sim::radio {

enum class RateControlKind : std::uint8_t { kFixed, kAarf, kMinstrel, kMinstrelHt, kIdeal };

/// Rate control of data frames, for each destination separately.
struct RateControlConfig {
  RateControlKind kind = RateControlKind::kFixed;

  std::uint32_t aarf_threshold = 10;      ///< Successive successes before a higher rate, >= 1.
  std::uint32_t aarf_max_threshold = 50;  ///< >= aarf_threshold.
  /// Transmissions at one rate, successful or not, before a higher one is probed, >= 1; doubled
  /// together with the threshold.
  std::uint32_t aarf_timeout = 15;

  /// Interval of the statistics, > 0.
  hal::Duration minstrel_interval = std::chrono::milliseconds{100};
  double minstrel_past = 0.75;     ///< Weight of the statistics before an interval, 0 .. < 1.
  double minstrel_sampling = 0.1;  ///< Share of frames that sample another rate, 0 .. 1.
  /// Of minstrel_ht: PPDUs between two samples, to which twice the mean number of MPDUs is added.
  std::uint32_t minstrel_ht_wait = 16;

  double ideal_loss = 0.01;  ///< Share of frames that a mode may lose, > 0, < 1.
};

}  // namespace sim::radio
