#pragma once

#include <bit>
#include <cstdint>
#include <map>

#include "hal/types/time.h"

namespace sim::air {

/// Counts of times in bins whose width is at most 1/32 of their lower edge, like G. Tene's
/// HdrHistogram: a bin is a power of two and the five bits below the leading one. Exact below 32
/// ns.
class LatencyHistogram {
 public:
  using Bin = std::uint32_t;

  static constexpr Bin bin_of(hal::Duration time) {
    const auto ns = static_cast<std::uint64_t>(time.count() < 0 ? 0 : time.count());
    if (ns < kSteps) return static_cast<Bin>(ns);
    const int shift = static_cast<int>(std::bit_width(ns)) - kBits - 1;
    return static_cast<Bin>((static_cast<std::uint64_t>(shift) + 1) * kSteps + (ns >> shift) -
                            kSteps);
  }
  /// Lower edge of a bin.
  static constexpr hal::Duration edge(Bin bin) {
    if (bin < kSteps) return hal::Duration{bin};
    const auto shift = bin / kSteps - 1;
    return hal::Duration{static_cast<std::int64_t>((bin % kSteps + kSteps) << shift)};
  }

  void add(hal::Duration time) {
    Count& count = counts_[bin_of(time)];
    ++count.times;
    count.changed = true;
  }

  struct Count {
    std::uint64_t times = 0;
    bool changed = false;  ///< Since it was last written.
  };
  std::map<Bin, Count>& counts() { return counts_; }
  const std::map<Bin, Count>& counts() const { return counts_; }

 private:
  static constexpr int kBits = 5;
  static constexpr std::uint64_t kSteps = 1U << kBits;

  std::map<Bin, Count> counts_;
};

}  // namespace sim::air
