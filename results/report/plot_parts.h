#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/report/plot.h"
#include "results/statistics/bootstrap.h"

namespace results::report {

/// Parts of make_plot(): one function for each kind of plot, which fills in the curves.

/// Mean and interval at each point versus a factor.
/// @param versus  factor of the x axis; none: nothing is varied.
/// @param by  factor that the curves' labels start with; none: no preference.
void add_points(Plot& plot, const Experiment& experiment, const Selected& of,
                const std::optional<std::size_t>& versus, const std::optional<std::size_t>& by);

/// A histogram for each point: from recorded bins, otherwise from samples, otherwise from the runs'
/// values.
void add_histogram(Plot& plot, const Experiment& experiment,
                   const sim::scenario::PlotRequest& request);

/// The mean over the runs of each point as a function of time.
void add_time(Plot& plot, const Experiment& experiment, const sim::scenario::PlotRequest& request);

/// Number of resamples for a bootstrap interval.
inline constexpr std::size_t kResamples = 2000;

/// The resamples for `count` values.
statistics::Resamples resamples_of(std::size_t count);

/// Mean, standard deviation and interval of the values of one setting's runs.
/// @return a mark with count 0 if there are no values.
Plot::Mark mark_of(const Sample& sample, sim::scenario::IntervalKind interval);

/// "delay / s", or "delay" if there is no unit.
std::string axis_label(const std::string& name, const std::string& unit);

/// The requested series by run: of the run itself, of the requested agent, or of all agents.
std::map<std::size_t, std::vector<Experiment::TimeSeries>> series_of(
    const Experiment& experiment, const sim::scenario::PlotRequest& request);

}  // namespace results::report
