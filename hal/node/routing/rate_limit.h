#pragma once

#include <algorithm>
#include <vector>

#include "hal/types/time.h"

namespace hal::node::routing {

/// Limits the number of events within any second.
class RateLimit {
 public:
  /// @param per_second  >= 1.
  explicit RateLimit(int per_second) : per_second_(static_cast<std::size_t>(per_second)) {}

  /// When the next event may happen: now or later.
  Time next(Time now) const {
    if (last_.size() < per_second_) return now;
    return std::max(now, last_.front() + kSpan);
  }

  void note(Time now) {
    if (last_.size() == per_second_) last_.erase(last_.begin());
    last_.push_back(now);
  }

 private:
  static constexpr Duration kSpan = std::chrono::seconds{1};

  std::size_t per_second_;
  std::vector<Time> last_;  ///< Times of the latest events, at most per_second_.
};

}  // namespace hal::node::routing
