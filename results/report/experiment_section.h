#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/report/experiment.h"
#include "results/report/plot.h"

namespace results::report {

/// What the runs are as an experiment: settings that are varied, runs, seeds, what was left out;
/// then each plot as a table, and how settings with the same seeds differ.
/// @throws std::runtime_error  a request names what is not there.
std::string experiment_section(const Experiment& experiment);

/// How numbers are written: with six significant digits, or such that they are read back the same.
enum class Digits : std::uint8_t { kSix, kExact };

/// One plot as a table: a row per mark.
std::string plot_text(const Plot& plot);

/// Head and rows of that table, for people and as the data behind the plot.
std::vector<std::vector<std::string>> plot_rows(const Plot& plot, Digits digits = Digits::kSix);

/// Differences of a quantity to the first setting, run by run with equal seeds: "" if there are no
/// two settings with the same seeds, at least two of them.
std::string pairs_text(const Experiment& experiment, const sim::scenario::PlotRequest& request);

/// The resamples of bootstrap intervals of these runs: of each number of runs of a setting one line
/// per resample, places of runs from 0 with commas between them.
std::string resamples_csv(const Experiment& experiment);

/// All quantities of the runs of one setting: mean, interval, spread.
std::string quantities_text(const Experiment& experiment);

}  // namespace results::report
