#pragma once

#include <string>
#include <vector>

#include "results/report/plot.h"

namespace results::report {

/// The plot as a drawing for a paper or a page: Scalable Vector Graphics 1.1 that needs nothing
/// else, black on nothing. Curves differ by colour (M. Okabe and K. Ito, "Color Universal Design",
/// 2008: told apart with any colour vision), mark and dash. Classes for a page's style: `axis`,
/// `curve-N`, and on what is counted `point`, `interval`, `bin`, `line`, `band`.
std::string svg(const Plot& plot);

/// Round numbers that divide an axis from `low` to `high` into about `count` parts, 1, 2 or 5 times
/// a power of ten apart; all within the axis. @pre low < high, count > 0.
std::vector<double> ticks(double low, double high, int count);

}  // namespace results::report
