#pragma once

#include "hal/types/time.h"

namespace sim::agents {

/// Reads the state of a run between events, at times that it chooses, without changing the run:
/// results are the same with and without a sampler. On the run's thread.
class Sampler {
 public:
  virtual ~Sampler() = default;
  /// Time of its next sample; Time::max(): none.
  virtual hal::Time due() const = 0;
  /// Takes a sample: all events up to and including `at` have run, and none after. Afterwards due()
  /// is later than `at`.
  virtual void look(hal::Time at) = 0;
};

}  // namespace sim::agents
