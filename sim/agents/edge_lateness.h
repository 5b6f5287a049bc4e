#pragma once

#include <algorithm>
#include <cstdint>

#include "hal/types/time.h"
#include "sim/agents/lateness.h"
#include "sim/agents/real_time.h"

namespace sim::agents {

/// Statistics of the lateness of frames at one edge between programs and the air, in simulated
/// time.
class EdgeLateness {
 public:
  explicit EdgeLateness(hal::Duration limit) : limit_(limit) {}

  void add(hal::Duration late) {
    const hal::Duration counted = std::max(late, hal::Duration::zero());
    ++frames_;
    beyond_ += counted > limit_ ? 1 : 0;
    lateness_.add(counted);
  }

  EdgeSummary summary() const {
    return {.frames = frames_,
            .beyond_limit = beyond_,
            .median = lateness_.quantile(0.5),
            .p99 = lateness_.quantile(0.99),
            .greatest = lateness_.greatest()};
  }

 private:
  hal::Duration limit_;
  std::uint64_t frames_ = 0, beyond_ = 0;
  Lateness lateness_;
};

}  // namespace sim::agents
