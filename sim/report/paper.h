#pragma once

#include "sim/report/quantiles.h"

namespace sim::report::paper {

/// What the paper reports of its case study: T. H. Labella, I. Dietrich, F. Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, figures 11 to 14.

/// Route discovery, s.
inline constexpr Quantiles kDiscovery{
    .min = 0.96e-3, .q1 = 2.11e-3, .median = 10.27e-3, .q3 = 60.72e-3, .max = 10.02};
/// End-to-end delay, s.
inline constexpr Quantiles kDelay{
    .min = 0.7e-3, .q1 = 0.7e-3, .median = 2.52e-3, .q3 = 8.7e-3, .max = 5.66};
/// Packets received over ten runs by the nodes that received most and least.
inline constexpr double kMostPackets = 4272;
inline constexpr double kLeastPackets = 1848;
inline constexpr int kRuns = 10;

}  // namespace sim::report::paper
