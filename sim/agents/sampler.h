#pragma once

#include "hal/types/time.h"

namespace sim::agents {

/// Looks at a run at times of its own choosing, between events, and changes nothing in it: a run
/// with a sampler is the same as one without. On the run's thread.
class Sampler {
 public:
  virtual ~Sampler() = default;
  /// When it wants to look next; Time::max(): not again.
  virtual hal::Time due() const = 0;
  /// All that happens at `at` or before has happened, and nothing after. Then due() is later.
  virtual void look(hal::Time at) = 0;
};

}  // namespace sim::agents
