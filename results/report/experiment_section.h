#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/report/experiment.h"
#include "results/report/plot.h"

namespace results::report {

/// Text about an experiment: varied settings, runs and runs left out; then each plot as a table,
/// and the differences between settings that were run with the same seeds.
/// @throws std::runtime_error  a plot request names something that does not exist.
std::string experiment_section(const Experiment& experiment);

/// How numbers are written: with six significant digits, or with enough digits to read back
/// exactly.
enum class Digits : std::uint8_t { kSix, kExact };

/// A plot as a text table with one row per mark.
std::string plot_text(const Plot& plot);

/// Head and rows of that table, also used as the data behind a drawn plot.
std::vector<std::vector<std::string>> plot_rows(const Plot& plot, Digits digits = Digits::kSix);

/// Differences of a quantity between the first setting and each other setting, from pairs of runs
/// with equal seeds. "" if no other setting shares at least two seeds with the first.
std::string pairs_text(const Experiment& experiment, const sim::scenario::PlotRequest& request);

/// The resamples behind the bootstrap intervals, for each occurring number of runs of a setting:
/// one line per resample, indices of runs from 0, separated by commas.
std::string resamples_csv(const Experiment& experiment);

/// All quantities of the runs of one setting: mean, interval, standard deviation, median.
std::string quantities_text(const Experiment& experiment);

}  // namespace results::report
