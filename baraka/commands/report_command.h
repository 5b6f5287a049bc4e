#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/plot_request.h"

namespace baraka::commands {

/// `baraka report`.
struct ReportOptions {
  std::vector<std::string> folders;  ///< Of results or campaigns.
  std::string file;               ///< Page (.html), figure (.svg) or its data (.csv); empty: print.
  std::string figure;             ///< Name of a quantity; empty: all that is there.
  std::string versus, by, agent;  ///< As in `report:`; empty: as there.
  std::optional<sim::scenario::PlotKind> as;
  std::optional<sim::scenario::IntervalKind> interval;
  std::string scenario;   ///< File whose `report:` counts; empty: that of the runs.
  std::string resamples;  ///< File for the resamples of bootstrap intervals; empty: none.
};

/// Prints tables, or writes a page or a figure.
/// @return exit status. @throws std::exception if something cannot be read, drawn or written.
int report(const ReportOptions& options);

}  // namespace baraka::commands
