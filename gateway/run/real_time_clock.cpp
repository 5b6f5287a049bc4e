#include "gateway/run/real_time_clock.h"

#include <algorithm>

#include "hal/dds/waiting.h"

namespace gateway {
namespace {

/// Ctrl-C is noticed, and the death of a process on another host, after at most this.
constexpr hal::Duration kSlice = std::chrono::milliseconds{50};

}  // namespace

hal::Time RealTimeClock::now() {
  const Clock::time_point wall = Clock::now();
  if (!start_) start_ = wall;
  const std::chrono::duration<double> passed = wall - *start_;
  return hal::Time{hal::from_seconds(passed.count() * factor_)};
}

bool RealTimeClock::wait(hal::Time until, std::span<const int> descriptors,
                         const sim::agents::Progress& progress) {
  if (pace_.may_go_on(until, progress) == WallPace::Verdict::kBreakOff) return false;
  const double left = hal::to_seconds(until - now()) / factor_;
  if (left > 0) hal::dds::wait_readable(descriptors, std::min(hal::from_seconds(left), kSlice));
  return true;
}

}  // namespace gateway
