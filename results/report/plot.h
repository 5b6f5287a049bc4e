#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "results/report/experiment.h"
#include "results/statistics/interval.h"
#include "sim/scenario/plot_request.h"

namespace results::report {

/// One figure of an experiment, ready to be drawn or printed.
struct Plot {
  /// One mark of a curve.
  struct Mark {
    double x = 0, y = 0;
    std::optional<statistics::Interval> interval;  ///< Of y, at statistics::kLevel.
    std::size_t count = 0;  ///< Number of runs behind the mark; in a histogram, of values.
    double sd = 0;          ///< Standard deviation over the runs.
    double width = 0;       ///< Histogram only: width of the bin.
    std::string x_text;     ///< x as written in the setting; empty: use x.
  };
  struct Curve {
    std::string label;
    std::vector<Mark> marks;  ///< Sorted by x.
  };

  std::string name;  ///< Used in file names and links: "messages.delivery_ratio".
  std::string title;
  sim::scenario::PlotKind kind = sim::scenario::PlotKind::kPoints;
  sim::scenario::IntervalKind interval = sim::scenario::IntervalKind::kStudent;
  std::string x_label, y_label;
  std::vector<std::string> categories;  ///< Texts at x = 0, 1, …; empty: x is a number.
  std::string curves_are;               ///< Settings in which the curves differ; empty: one curve.
  std::vector<Curve> curves;            ///< Not empty.
  std::vector<std::string> notes;       ///< Warnings for the reader: too few runs …
  /// Values that the quantity can take, for its intervals: see statistics::mean_interval().
  statistics::Support::Kind support = statistics::Support::Kind::kReal;
};

/// @throws std::runtime_error  the experiment has no such quantity, agent or setting (the message
///   lists what it has), or the quantity was not recorded in the form that the plot needs.
Plot make_plot(const Experiment& experiment, const sim::scenario::PlotRequest& request);

/// The plots that the experiment requests. If it requests none: the observables of `record:
/// {observables: …}` and, if settings were varied, up to six common quantities of the run that
/// differ between them.
std::vector<sim::scenario::PlotRequest> requests_of(const Experiment& experiment);

/// The request with the quantity's full name. Accepts "known" for "controllers.known", and
/// "controllers.r0.known" for the quantity of one agent, as docs/observables.md and the view write
/// it. Returns the request unchanged if there is no such quantity.
/// @throws std::runtime_error  several quantities have that name
sim::scenario::PlotRequest with_full_name(const Experiment& experiment,
                                          sim::scenario::PlotRequest request);

/// A hint for an unknown name: "; did you mean 'paths.mean'?", otherwise quantities that contain
/// the word: "; there is run.simulated" for "simulated_s". "": there is no similar name.
std::string nearest_names(const Experiment& experiment, const std::string& name);

/// Plots of the observables of `record: {observables: …}`.
std::vector<sim::scenario::PlotRequest> observed_requests(const Experiment& experiment);

/// One value per run of a quantity: of the run itself, of one agent, or the mean over the agents
/// that have it.
struct Selected {
  std::map<std::size_t, double> values;  ///< By run.
  std::string whose;                     ///< "", "m17", "mean of 25 agents".
  statistics::Support::Kind support = statistics::Support::Kind::kReal;
  /// Number of trials by run, if the quantity is a share of trials; otherwise empty.
  std::map<std::size_t, double> trials{};
};

/// The values of some runs and the values that they can take.
struct Sample {
  std::vector<double> values;
  statistics::Support support;
};
Sample sample_of(const std::vector<std::size_t>& runs, const Selected& of);

/// The values that the quantity of this name can take.
statistics::Support::Kind support_of(const std::string& name);

/// The method that gives the interval of a mean: "Student's t" or "score by Student's t".
std::string_view name_of_interval(statistics::Support::Kind support);
/// None: the experiment has no such quantity, or not for that agent.
std::optional<Selected> select(const Experiment& experiment, const std::string& name,
                               const std::string& agent);

}  // namespace results::report
