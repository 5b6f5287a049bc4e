#include "gateway/run/real_time_clock.h"

#include <algorithm>
#include <vector>

namespace gateway {
namespace {

/// Ctrl-C is noticed, and the death of a process on another host, after at most this.
constexpr hal::Duration kSlice = std::chrono::milliseconds{50};

}  // namespace

hal::Time RealTimeClock::now() {
  const hal::Time wall = pace_.clock().now();
  if (!start_) start_ = wall;
  return hal::Time{hal::from_seconds(hal::to_seconds(wall - *start_) * factor_)};
}

bool RealTimeClock::wait(hal::Time until, std::span<const int> descriptors,
                         const sim::agents::Progress& progress) {
  if (pace_.may_go_on(until, progress) == WallPace::Verdict::kBreakOff) return false;
  const double left = hal::to_seconds(until - now()) / factor_;
  if (left <= 0) return true;
  std::vector<pollfd> polled;
  polled.reserve(descriptors.size());
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  pace_.clock().wait(polled, std::min(hal::from_seconds(left), kSlice));
  return true;
}

}  // namespace gateway
