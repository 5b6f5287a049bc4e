#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/types/time.h"

namespace sim::agents {

/// Distribution of how late something was, in constant memory however often it is asked for. Counts
/// per interval: 64 to each doubling, so a quantile is at most 1.6 % too large (as HdrHistogram,
/// G. Tene, 2012).
class Lateness {
 public:
  /// @param late  0 or more.
  void add(hal::Duration late);

  /// The upper end of the interval that holds the value of this rank, but no more than greatest();
  /// 0 if there is none. @param q  0 .. 1
  hal::Duration quantile(double q) const;

  hal::Duration greatest() const { return greatest_; }  ///< Exactly.

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
