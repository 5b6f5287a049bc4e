#pragma once

#include <string>
#include <vector>

#include "results/report/plot.h"

namespace results::report {

/// The plot as a self-contained drawing for a paper or a page: Scalable Vector Graphics 1.1, black
/// on a transparent background. Curves differ in colour (M. Okabe and K. Ito, "Color Universal
/// Design", 2008: distinguishable with any colour vision), mark and dash. Classes for style sheets:
/// `axis`, `curve-N`, and for data `point`, `interval`, `bin`, `line`, `band`.
std::string svg(const Plot& plot);

}  // namespace results::report
