#pragma once

#include <string>
#include <vector>

#include "results/report/plot.h"
#include "results/statistics/paired.h"

namespace results::report {

/// How a setting differs from the first one, over runs with equal seeds.
struct PairedDifference {
  std::string setting;
  statistics::PairedComparison pairs;
};

/// One for each setting but the first, in their order, without those that have too few pairs.
/// Empty: nothing is varied, or there is no such quantity of a run.
std::vector<PairedDifference> paired_differences(const Experiment& experiment,
                                                 const sim::scenario::PlotRequest& asked);

}  // namespace results::report
