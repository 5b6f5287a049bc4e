#include "results/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "results/report/plot_parts.h"

namespace results::report {
namespace {

constexpr std::size_t kDefaultPlots = 6;
constexpr std::size_t kEnoughForBootstrap = 50;

/// Quantities of the run that are plotted if no plot was requested, most preferred first.
constexpr const char* kPreferred[] = {"messages.delivery_ratio", "messages.delay.median",
                                      "messages.delay.p95",      "messages.goodput",
                                      "run.simulated",           "paths.mean",
                                      "discoveries.time.median", "frames.sent"};

std::size_t factor_or_throw(const Experiment& experiment, const std::string& key) {
  if (const auto factor = experiment.factor(key)) return *factor;
  std::string keys;
  for (const Experiment::Factor& one : experiment.factors) keys += "\n  " + one.key;
  throw std::runtime_error(fmt::format(
      "{}: is no setting in which these runs differ{}", key,
      keys.empty() ? "; they do not differ in any but the seed" : "; they differ in" + keys));
}

std::optional<std::size_t> optional_factor(const Experiment& experiment, const std::string& key) {
  return key.empty() ? std::nullopt : std::optional(factor_or_throw(experiment, key));
}

/// The factor of the x axis: the first that does not change together with `by`, whose levels are
/// the curves.
std::optional<std::size_t> default_factor(const Experiment& experiment,
                                          const std::optional<std::size_t>& by) {
  if (experiment.factors.empty()) return std::nullopt;
  for (std::size_t i = 0; by && i < experiment.factors.size(); ++i) {
    if (experiment.first_like(i) != experiment.first_like(*by)) return i;
  }
  return 0;
}

void check_is_there(const Experiment& experiment, const sim::scenario::PlotRequest& request) {
  const auto& name = request.plot;
  if (!experiment.units.contains(name)) {
    throw std::runtime_error(
        fmt::format("{}: none of these runs has such a quantity{}; baraka describe observables "
                    "lists those of every run",
                    name, nearest_names(experiment, name)));
  }
  if (request.agent.empty()) return;
  const Experiment::Quantity whose{name, request.agent};
  if (experiment.values.contains(whose) || experiment.series.contains(whose) ||
      experiment.bins.contains(whose)) {
    return;
  }
  throw std::runtime_error(
      fmt::format("{}: none of these runs has it for '{}'", name, request.agent));
}

sim::scenario::PlotKind kind_of(const Experiment& experiment,
                                const sim::scenario::PlotRequest& request) {
  if (request.as != sim::scenario::PlotKind::kAutomatic) return request.as;
  const bool is_value = select(experiment, request.plot, request.agent).has_value();
  // A series alone has no single value to plot versus a setting: add_points_of() reports that.
  if (!request.versus.empty() || !request.by.empty()) return sim::scenario::PlotKind::kPoints;
  if (is_value && !experiment.factors.empty()) return sim::scenario::PlotKind::kPoints;
  return series_of(experiment, request).empty() ? sim::scenario::PlotKind::kHistogram
                                                : sim::scenario::PlotKind::kTime;
}

void note_few_runs(Plot& plot, const Experiment& experiment) {
  std::size_t fewest = experiment.runs.size();
  for (const Experiment::Point& point : experiment.points) {
    fewest = std::min(fewest, point.runs.size());
  }
  if (plot.interval == sim::scenario::IntervalKind::kBootstrap && fewest < kEnoughForBootstrap) {
    plot.notes.push_back(fmt::format(
        "{} runs of a setting: a bootstrap interval needs {} to hold 95 %; see docs/statistics.md",
        fewest, kEnoughForBootstrap));
  }
  if (fewest >= statistics::kFewestRuns) return;
  plot.notes.push_back(
      fewest < 2 ? "one run of a setting: its variation is unknown, and there is no interval; more "
                   "replications are needed"
                 : fmt::format("only {} runs of a setting: too few to trust its interval; at least "
                               "{} replications are needed",
                               fewest, statistics::kFewestRuns));
}

/// The share of the variance that lies between the points, 0 .. 1.
double share_between(const Experiment& experiment, const std::map<std::size_t, double>& values) {
  std::vector<double> all;
  all.reserve(values.size());
  for (const auto& [run, value] : values) all.push_back(value);
  const auto total = statistics::moments(all);
  if (!total || total->sd <= 0) return 0;
  double within = 0;
  for (const Experiment::Point& point : experiment.points) {
    std::vector<double> some;
    for (const std::size_t run : point.runs) {
      if (const auto found = values.find(run); found != values.end()) some.push_back(found->second);
    }
    const auto of = statistics::moments(some);
    if (of) within += of->sd * of->sd * static_cast<double>(of->count - 1);
  }
  return 1 - within / (total->sd * total->sd * static_cast<double>(total->count - 1));
}

/// Adds points versus the requested factors, or the first factors if none is requested.
void add_points_of(Plot& plot, const Experiment& experiment,
                   const sim::scenario::PlotRequest& request, const std::optional<Selected>& of) {
  if (!of) {
    std::string others;
    for (const char* ending : {".mean", ".last"}) {
      if (!experiment.units.contains(request.plot + ending)) continue;
      others += (others.empty() ? "; these are of a run: " : ", ") + request.plot + ending;
    }
    throw std::runtime_error(
        fmt::format("{}: has no single value per run; `as: time` or `as: histogram` shows it{}",
                    request.plot, others));
  }
  const auto by = optional_factor(experiment, request.by);
  auto versus = optional_factor(experiment, request.versus);
  if (!versus) versus = default_factor(experiment, by);
  add_points(plot, experiment, *of, versus, by);
}

}  // namespace

std::string axis_label(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} / {}", name, unit);
}

statistics::Support::Kind support_of(const std::string& name) {
  using Kind = statistics::Support::Kind;
  switch (record::range_of(name)) {
    case record::Range::kNotNegative:
      return Kind::kNotNegative;
    case record::Range::kCount:
      return Kind::kCount;
    case record::Range::kShare:
      return Kind::kShare;
    case record::Range::kAny:
      break;
  }
  return Kind::kReal;
}

std::string_view name_of_interval(statistics::Support::Kind support) {
  return support == statistics::Support::Kind::kReal ? "Student's t" : "score by Student's t";
}

Sample sample_of(const std::vector<std::size_t>& runs, const Selected& of) {
  Sample sample{{}, {of.support, {}}};
  for (const std::size_t run : runs) {
    const auto value = of.values.find(run);
    if (value == of.values.end()) continue;
    sample.values.push_back(value->second);
    const auto trials = of.trials.find(run);
    if (trials == of.trials.end()) continue;
    sample.support.trials = sample.support.trials.value_or(0) + trials->second;
  }
  return sample;
}

static std::optional<Selected> values_of(const Experiment& experiment, const std::string& name,
                                         const std::string& agent) {
  const auto own = experiment.values.find({name, agent});
  if (own != experiment.values.end()) return Selected{.values = own->second, .whose = agent};
  if (!agent.empty()) return std::nullopt;
  std::map<std::size_t, std::pair<double, std::size_t>> sums;
  std::size_t agents = 0;
  for (auto at = experiment.values.lower_bound({name, ""});
       at != experiment.values.end() && at->first.name == name; ++at, ++agents) {
    for (const auto& [run, value] : at->second) {
      sums[run].first += value;
      ++sums[run].second;
    }
  }
  if (agents == 0) return std::nullopt;
  Selected selected{.values = {}, .whose = fmt::format("mean of {} agents", agents)};
  if (agents == 1) selected.whose = experiment.values.lower_bound({name, ""})->first.agent;
  for (const auto& [run, sum] : sums) {
    selected.values[run] = sum.first / static_cast<double>(sum.second);
  }
  return selected;
}

std::optional<Selected> select(const Experiment& experiment, const std::string& name,
                               const std::string& agent) {
  std::optional<Selected> selected = values_of(experiment, name, agent);
  if (!selected) return selected;
  selected->support = support_of(name);
  const auto trials = experiment.values.find({record::trials_of(name), agent});
  if (trials != experiment.values.end()) selected->trials = trials->second;
  return selected;
}

Plot make_plot(const Experiment& experiment, const sim::scenario::PlotRequest& asked) {
  const sim::scenario::PlotRequest request = with_full_name(experiment, asked);
  check_is_there(experiment, request);
  Plot plot;
  plot.kind = kind_of(experiment, request);
  plot.interval = request.interval;
  plot.support = support_of(request.plot);
  plot.name = request.agent.empty() ? request.plot : request.plot + "." + request.agent;
  const auto of = select(experiment, request.plot, request.agent);
  const std::string whose = of ? of->whose : request.agent;
  plot.title = whose.empty() ? request.plot : fmt::format("{} ({})", request.plot, whose);
  plot.y_label = axis_label(request.plot, experiment.units.at(request.plot));
  if (plot.kind == sim::scenario::PlotKind::kHistogram) {
    add_histogram(plot, experiment, request);
    return plot;
  }
  if (plot.kind == sim::scenario::PlotKind::kTime) {
    add_time(plot, experiment, request);
  } else {
    add_points_of(plot, experiment, request, of);
  }
  note_few_runs(plot, experiment);
  return plot;
}

std::vector<sim::scenario::PlotRequest> requests_of(const Experiment& experiment) {
  if (!experiment.requests.empty()) return experiment.requests;
  std::vector<sim::scenario::PlotRequest> requests = observed_requests(experiment);
  if (experiment.points.size() < 2) return requests;
  const std::size_t observed = requests.size();
  for (const char* name : kPreferred) {
    const auto of = select(experiment, name, "");
    if (!of || share_between(experiment, of->values) <= 0) continue;
    if (requests.size() - observed < kDefaultPlots) requests.push_back({.plot = name});
  }
  return requests;
}

}  // namespace results::report
