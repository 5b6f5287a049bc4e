#include "sim/agents/lateness.h"

#include <algorithm>
#include <bit>

namespace sim::agents {

/// Below kStepsPerDoubling each number has its own interval; above, the highest bits select it.
std::size_t Lateness::interval_of(std::uint64_t ns) {
  const int shift = std::max(static_cast<int>(std::bit_width(ns)) - kStepBits - 1, 0);
  return static_cast<std::size_t>(shift) * kStepsPerDoubling + (ns >> shift);
}

/// Largest number in the interval.
std::uint64_t Lateness::end_of(std::size_t interval) {
  if (interval < 2 * kStepsPerDoubling) return interval;
  const std::size_t shift = interval / kStepsPerDoubling - 1;
  return ((interval - shift * kStepsPerDoubling + 1) << shift) - 1;
}

void Lateness::add(hal::Duration late) {
  ++counts_[interval_of(static_cast<std::uint64_t>(late.count()))];
  ++count_;
  greatest_ = std::max(greatest_, late);
}

hal::Duration Lateness::quantile(double q) const {
  if (count_ == 0) return {};
  auto rank = static_cast<std::uint64_t>(q * static_cast<double>(count_ - 1));
  std::size_t interval = 0;
  for (; counts_[interval] <= rank; ++interval) rank -= counts_[interval];
  return std::min(hal::Duration{static_cast<std::int64_t>(end_of(interval))}, greatest_);
}

}  // namespace sim::agents
