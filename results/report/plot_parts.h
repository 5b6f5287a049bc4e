#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/report/plot.h"
#include "results/statistics/bootstrap.h"

namespace results::report {

/// The parts that make_plot() is made of: each fills the curves of its kind.

/// Mean and interval at each point, versus a factor. @param versus  none: nothing is varied.
void add_points(Plot& plot, const Experiment& experiment, const Selected& of,
                const std::optional<std::size_t>& versus, const std::optional<std::size_t>& by);

/// How often which values, of each point: of the bins that were recorded, else of the samples, else
/// of the runs' values.
void add_histogram(Plot& plot, const Experiment& experiment,
                   const sim::scenario::PlotRequest& request);

/// The series over time, mean over the runs of each point.
void add_time(Plot& plot, const Experiment& experiment, const sim::scenario::PlotRequest& request);

/// Resamples of a bootstrapped interval.
inline constexpr std::size_t kResamples = 2000;

/// Those for so many values.
statistics::Resamples resamples_of(std::size_t count);

/// Mean, spread and interval of the values of one setting's runs.
/// @return  with count 0 for no values.
Plot::Mark mark_of(const Sample& sample, sim::scenario::IntervalKind interval);

/// "delay / s"; "delay" without a unit.
std::string axis_label(const std::string& name, const std::string& unit);

/// The series that are asked for, run by run: of the run, of the agent, or of all agents.
std::map<std::size_t, std::vector<Experiment::TimeSeries>> series_of(
    const Experiment& experiment, const sim::scenario::PlotRequest& request);

}  // namespace results::report
