#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/plot_request.h"

namespace baraka::commands {

/// The command line of `baraka report`.
struct ReportOptions {
  std::vector<std::string> folders;  ///< Folders of results or campaigns.
  std::string file;    ///< Page (.html), figure (.svg) or its data (.csv) to write; empty: print.
  std::string figure;  ///< Quantity, or a pattern of several; empty: the whole report.
  std::string versus, by, agent;  ///< Override the keys of `report:`; empty: no override.
  std::optional<sim::scenario::PlotKind> as;
  std::optional<sim::scenario::IntervalKind> interval;
  std::string scenario;   ///< File whose `report:` applies; empty: that of the runs' scenario.
  std::string resamples;  ///< File to write the resamples of bootstrap intervals to; empty: none.
};

/// Prints tables, or writes a page or a figure.
/// @return exit status. @throws std::exception if something cannot be read, drawn or written.
int report(const ReportOptions& options);

/// The page of a result or campaign, as `report -o FILE.html` writes it.
/// @throws std::exception  as report(); this installation has no page.
std::string page_of(const std::string& folder);

}  // namespace baraka::commands
