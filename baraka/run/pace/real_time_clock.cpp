#include "baraka/run/pace/real_time_clock.h"

#include <algorithm>

namespace baraka::run::pace {
namespace {

/// Ctrl-C and the death of a process on another host are noticed within this time.
constexpr hal::Duration kSlice = std::chrono::milliseconds{50};

}  // namespace

hal::Time RealTimeClock::now() {
  const hal::Time wall = pace_.clock().now();
  if (!start_) start_ = wall;
  return simulated(wall);
}

hal::Time RealTimeClock::simulated(hal::Time wall) const {
  return hal::Time{hal::from_seconds(hal::to_seconds(wall - *start_) * factor_)};
}

bool RealTimeClock::wait(hal::Time until, std::span<const int> descriptors,
                         const sim::agents::Progress& progress) {
  if (pace_.may_go_on(until, progress) == WallPace::Verdict::kBreakOff) return false;
  if (background_ != nullptr) background_->attend(now());
  hal::Time stop = until;
  hal::Duration longest = kSlice;
  if (background_ != nullptr) {
    stop = std::min(until, background_->next().value_or(until));
    longest = std::min(kSlice, background_->longest_wait());
  }
  const hal::Duration spin = background_ != nullptr ? background_->spin() : hal::Duration{};
  const double left = hal::to_seconds(stop - now()) / factor_ - hal::to_seconds(spin);
  if (left <= 0) return true;
  polled_.clear();
  for (const int descriptor : descriptors) polled_.push_back({descriptor, POLLIN, 0});
  if (background_ != nullptr) {
    polled_.push_back({background_->descriptor(), POLLIN, 0});
    background_->before_wait();
  }
  pace_.clock().wait(polled_, std::min(hal::from_seconds(left), longest));
  if (background_ != nullptr) background_->after_wait();
  return true;
}

}  // namespace baraka::run::pace
