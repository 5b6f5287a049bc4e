// Names of quantities as the view and docs/observables.md show them, and plots of observables.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "hal/files/config/suggest.h"
#include "results/record/topic_name.h"
#include "results/report/plot.h"
#include "sim/scenario/observable.h"

namespace results::report {
namespace {

constexpr std::size_t kMostObserved = 30;  ///< Most plots for patterns such as agents.*.*.

std::string after_domain(const std::string& name) {
  const std::size_t dot = name.find('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

std::vector<std::string> names_of(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const auto& [name, unit] : experiment.units) names.push_back(name);
  return names;
}

bool has_of(const Experiment& experiment, const std::string& name, const std::string& agent) {
  const Experiment::Quantity whose{name, agent};
  return experiment.values.contains(whose) || experiment.series.contains(whose) ||
         experiment.bins.contains(whose);
}

/// The name itself, or the name of its mean if only sums were kept; none: no such quantity.
std::optional<std::string> kept_as(const Experiment& experiment, const std::string& name) {
  for (const std::string& one : {name, name + ".mean"}) {
    if (experiment.units.contains(one)) return one;
  }
  return std::nullopt;
}

/// Resolves the name of a quantity of one agent, such as "controllers.r0.known".
std::optional<sim::scenario::PlotRequest> with_agent(const Experiment& experiment,
                                                     sim::scenario::PlotRequest request) {
  const auto parts = sim::scenario::ObservablePattern::of(request.plot);
  if (!parts) return std::nullopt;
  const auto name = kept_as(experiment, parts->domain + "." + parts->value);
  const bool is_everyone = parts->agents == "*";
  if (!name || (!is_everyone && !has_of(experiment, *name, parts->agents))) return std::nullopt;
  request.plot = *name;
  if (!is_everyone) request.agent = parts->agents;
  return request;
}

/// Quantities whose name without the domain is `part`, including those with only a mean.
std::set<std::string> of_any_domain(const Experiment& experiment, const std::string& part) {
  std::set<std::string> found;
  for (const auto& [one, unit] : experiment.units) {
    const std::string whole = one.ends_with(".mean") ? one.substr(0, one.size() - 5) : one;
    if (after_domain(one) == part || after_domain(whole) == part) {
      found.insert(experiment.units.contains(whole) ? whole : one);
    }
  }
  return found;
}

/// Resolves a name without its domain: "known" for "controllers.known".
/// @throws std::runtime_error  several domains have it
std::optional<std::string> without_domain(const Experiment& experiment, const std::string& name) {
  std::set<std::string> found = of_any_domain(experiment, name);
  found.merge(of_any_domain(experiment, record::name_part(name)));
  if (found.empty()) return std::nullopt;
  if (found.size() == 1) return *found.begin();
  throw std::runtime_error(fmt::format("{}: which of {}?", name, fmt::join(found, ", ")));
}

/// A name without its domain as `record: {observables: …}` writes it.
std::string as_written(const std::string& domain, const std::string& name) {
  return domain == sim::scenario::kDdsDomain ? record::topic_of_part(name) : name;
}

/// Quantities that match a pattern of `record: {observables: …}`, without endings such as ".mean".
std::set<std::string> observed(const Experiment& experiment,
                               const sim::scenario::ObservablePattern& pattern) {
  std::set<std::string> names;
  for (const auto& [name, unit] : experiment.units) {
    if (!name.starts_with(pattern.domain + ".")) continue;
    const std::string value = after_domain(name);
    const std::string base = value.ends_with(".mean") ? value.substr(0, value.size() - 5) : value;
    if (pattern.has_value(as_written(pattern.domain, base)))
      names.insert(pattern.domain + "." + base);
  }
  return names;
}

/// The quantity that is called so but for capitals: "states.ARRIVED.first", as controllers write
/// their states, is kept as "states.arrived.first".
std::optional<std::string> in_other_case(const Experiment& experiment, const std::string& name) {
  std::string lower = name;
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return kept_as(experiment, lower);
}

/// Requests plots of an observable: versus the varied settings, and over time or as a histogram if
/// it was kept in that form.
void request_observed(std::vector<sim::scenario::PlotRequest>& requests,
                      const Experiment& experiment, const std::string& name,
                      const std::string& agent) {
  const auto add = [&](const std::string& plot, sim::scenario::PlotKind as) {
    const auto is_same = [&](const sim::scenario::PlotRequest& one) {
      return one.plot == plot && one.agent == agent;
    };
    if (std::ranges::any_of(requests, is_same) || requests.size() >= kMostObserved) return;
    requests.push_back({.plot = plot, .agent = agent, .as = as});
  };
  const auto has = [&name](const auto& of) {
    return std::ranges::any_of(of, [&name](const auto& one) { return one.first.name == name; });
  };
  const bool is_kept = has(experiment.series) || has(experiment.bins);
  const bool has_mean = experiment.units.contains(name + ".mean");
  if (has_mean && (!is_kept || experiment.points.size() > 1)) {
    add(name + ".mean", experiment.points.size() > 1 ? sim::scenario::PlotKind::kPoints
                                                     : sim::scenario::PlotKind::kTable);
  }
  if (has(experiment.series)) return add(name, sim::scenario::PlotKind::kTime);
  if (has(experiment.bins)) add(name, sim::scenario::PlotKind::kHistogram);
}

}  // namespace

sim::scenario::PlotRequest with_full_name(const Experiment& experiment,
                                          sim::scenario::PlotRequest request) {
  if (experiment.units.contains(request.plot)) return request;
  if (const auto name = kept_as(experiment, request.plot)) {
    request.plot = *name;
  } else if (const auto of_agent = with_agent(experiment, request)) {
    return *of_agent;
  } else if (const auto whole = without_domain(experiment, request.plot)) {
    request.plot = *whole;
  } else if (const auto same = in_other_case(experiment, request.plot)) {
    request.plot = *same;
  }
  return request;
}

std::string nearest_names(const Experiment& experiment, const std::string& name) {
  std::vector<std::string> names = names_of(experiment);
  if (std::string near = hal::files::config::suggestion(name, names); !near.empty()) return near;
  std::vector<std::string> short_names;
  short_names.reserve(names.size());
  for (const std::string& one : names) short_names.push_back(after_domain(one));
  const std::string near = hal::files::config::suggestion(name, short_names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (near.find("'" + short_names[i] + "'") == std::string::npos) continue;
    return fmt::format("; did you mean '{}'?", names[i]);
  }
  constexpr std::size_t kMost = 5;
  constexpr std::size_t kShortest = 4;  // characters of the shortest word to look for
  const std::string stem = name.substr(0, name.rfind('_'));
  std::string found;
  std::size_t count = 0;
  for (const std::string& one : names) {
    if (stem.size() < kShortest || one.find(stem) == std::string::npos || count == kMost) continue;
    found += (count++ == 0 ? "; there is " : ", ") + one;
  }
  return found;
}

std::vector<sim::scenario::PlotRequest> observed_requests(const Experiment& experiment) {
  std::vector<sim::scenario::PlotRequest> requests;
  if (experiment.runs.empty()) return requests;
  for (const std::string& name : experiment.observables) {
    const auto pattern = sim::scenario::ObservablePattern::of(name);
    if (!pattern) continue;
    const bool is_one = pattern->agents.find_first_of("*?") == std::string::npos;
    for (const std::string& one : observed(experiment, *pattern)) {
      request_observed(requests, experiment, one, is_one ? pattern->agents : "");
    }
  }
  return requests;
}

}  // namespace results::report
