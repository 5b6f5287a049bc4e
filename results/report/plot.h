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
  /// One place of a curve. With the number of runs (or values, of a histogram) behind it.
  struct Mark {
    double x = 0, y = 0;
    std::optional<statistics::Interval> interval;  ///< Of y, at statistics::kLevel.
    std::size_t count = 0;
    double sd = 0;       ///< Over the runs.
    double width = 0;    ///< Of a bar.
    std::string x_text;  ///< As written in the setting; empty: x.
  };
  struct Curve {
    std::string label;
    std::vector<Mark> marks;  ///< By x.
  };

  std::string name;  ///< For files and links: "messages.delivery_ratio".
  std::string title;
  sim::scenario::PlotKind kind = sim::scenario::PlotKind::kPoints;
  sim::scenario::IntervalKind interval = sim::scenario::IntervalKind::kStudent;
  std::string x_label, y_label;
  std::vector<std::string> categories;  ///< Texts at x = 0, 1, …; empty: x is a number.
  std::string curves_are;               ///< What the curves differ in; empty: there is one.
  std::vector<Curve> curves;            ///< Not empty.
  std::vector<std::string> notes;       ///< What the reader must know: too few runs …
  /// What the quantity can be, for its intervals: see statistics::mean_interval().
  statistics::Support::Kind support = statistics::Support::Kind::kReal;
};

/// @throws std::runtime_error  the experiment has no such quantity, agent or setting, with what it
///   has instead; or nothing of that kind.
Plot make_plot(const Experiment& experiment, const sim::scenario::PlotRequest& request);

/// What the experiment asks for; else what `record: {observables: …}` asked to be followed and, if
/// settings were varied, the quantities of the run that differ most between them.
std::vector<sim::scenario::PlotRequest> requests_of(const Experiment& experiment);

/// The request with the name that the experiment has for it: also "known" for "controllers.known",
/// and "controllers.r0.known" for that of one agent, as docs/observables.md and the view have it.
/// As it is, if there is no such quantity.
/// @throws std::runtime_error  several quantities have that name
sim::scenario::PlotRequest with_full_name(const Experiment& experiment,
                                          sim::scenario::PlotRequest request);

/// "; did you mean 'paths.mean'?", else "; there is run.simulated" for "simulated_s"; "": nothing.
std::string nearest_names(const Experiment& experiment, const std::string& name);

/// Of what `record: {observables: …}` asked to be followed.
std::vector<sim::scenario::PlotRequest> observed_requests(const Experiment& experiment);

/// A quantity of each run: of the run itself, of one agent, or the mean over those that have it.
struct Selected {
  std::map<std::size_t, double> values;  ///< By run.
  std::string whose;                     ///< "", "m17", "mean of 25 agents".
  statistics::Support::Kind support = statistics::Support::Kind::kReal;
  std::map<std::size_t, double> trials{};  ///< By run, of a share of trials; empty: it is none.
};

/// The values of some runs and what is known of them.
struct Sample {
  std::vector<double> values;
  statistics::Support support;
};
Sample sample_of(const std::vector<std::size_t>& runs, const Selected& of);

/// What a quantity of that name can be.
statistics::Support::Kind support_of(const std::string& name);

/// "Student's t", "the score, by Student's t": how the intervals of means are made.
std::string_view name_of_interval(statistics::Support::Kind support);
/// None: the experiment has no such quantity, or not of that agent.
std::optional<Selected> select(const Experiment& experiment, const std::string& name,
                               const std::string& agent);

}  // namespace results::report
