#pragma once

#include <string>
#include <vector>

#include "results/report/paired_differences.h"
#include "results/report/plot.h"

namespace results::report {

/// A figure for other programs, such as the Python package, with all digits:
///
///   {"name", "title", "kind": points | histogram | time | table, "x_label", "y_label",
///   "curves_are",
///    "interval": how it was made, "level": 0.95, "notes": [text],
///    "curves": [{"label", "marks": [{"x", "setting": text or null, "y", "low", "high", "sd",
///    "count", "width"}]}], "first": the setting that others are compared with, "differences":
///    [{"setting", "pairs", "difference", "low", "high", "p", "correlation"}]}
///
/// What is not known is null: an interval of one run, p of equal differences.
std::string plot_json(const Plot& plot, const std::string& first,
                      const std::vector<PairedDifference>& differences);

}  // namespace results::report
