#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/topic_traffic.h"

namespace sim::scenario {

/// The key `size`: a size, a list of sizes, or a range {from, to}.
void size_key(Fields& io, SampleSizes& sizes);

/// The keys `rate` with `jitter`, `poisson` or `bursts`, of which one must be given.
void rhythm_keys(Fields& io, SampleRhythm& rhythm);

}  // namespace sim::scenario
