#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/types/time.h"

namespace sim::agents {

/// Distribution of delays in constant memory, with quantiles at any time. Counts per interval, 64
/// intervals to each doubling, so a quantile is at most 1.6 % too large (as in HdrHistogram, G.
/// Tene, 2012).
class Lateness {
 public:
  /// @param late  >= 0.
  void add(hal::Duration late);

  /// Upper end of the interval that contains the q-quantile, limited to greatest(); 0 if nothing
  /// was added. @param q  0 .. 1
  hal::Duration quantile(double q) const;

  hal::Duration greatest() const { return greatest_; }  ///< Exact.

 private:
  static constexpr int kStepBits = 6;
  static constexpr std::size_t kStepsPerDoubling = std::size_t{1} << kStepBits;
  static constexpr std::size_t kIntervals = (64 - kStepBits) * kStepsPerDoubling;
  static std::size_t interval_of(std::uint64_t ns);
  static std::uint64_t end_of(std::size_t interval);

  std::array<std::uint64_t, kIntervals> counts_{};
  std::uint64_t count_ = 0;
  hal::Duration greatest_{};
};

}  // namespace sim::agents
