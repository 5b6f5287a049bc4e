#include "results/report/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace results::report {

namespace {

/// Whether a setting may change what controllers do: which there are, and their parameters.
bool is_of_controllers(const std::string& key) {
  return key == "agents" || key.starts_with("agents.") || key == "include" ||
         key == "version of baraka";
}

/// Runs grouped by the settings on which their controllers depend.
std::vector<std::vector<std::size_t>> runs_of_equal_controllers(const Experiment& experiment) {
  std::map<std::vector<std::string>, std::vector<std::size_t>> runs;
  for (const Experiment::Point& point : experiment.points) {
    std::vector<std::string> levels;
    for (std::size_t i = 0; i < experiment.factors.size(); ++i) {
      if (is_of_controllers(experiment.factors[i].key)) levels.push_back(point.levels[i].text);
    }
    auto& equal = runs[levels];
    equal.insert(equal.end(), point.runs.begin(), point.runs.end());
  }
  std::vector<std::vector<std::size_t>> parts;
  parts.reserve(runs.size());
  for (auto& [levels, equal] : runs) parts.push_back(std::move(equal));
  return parts;
}

/// Gives the runs in `equal` that have no value the value 0, if at least one of them has a value.
/// @param counts  whether a run counts such a thing at all.
template <class Counts>
void complete(std::map<std::size_t, double>& by_run, const std::vector<std::size_t>& equal,
              const Counts& counts) {
  const auto has_it = [&by_run](std::size_t run) { return by_run.contains(run); };
  if (std::ranges::none_of(equal, has_it)) return;
  for (const std::size_t run : equal) {
    if (counts(run)) by_run.try_emplace(run, 0);
  }
}

/// The values of a quantity that runs as a whole have.
template <class Values>
std::map<std::size_t, double> of_runs(const Values& values, const char* name) {
  const auto found = values.find({name, ""});
  return found == values.end() ? std::map<std::size_t, double>() : found->second;
}

}  // namespace

void Experiment::complete_open_counts() {
  const auto parts = runs_of_equal_controllers(*this);
  // Only runs that count messages, or samples, have these.
  const std::map<std::size_t, double> with_messages = of_runs(values, "messages.sent");
  const std::map<std::size_t, double> with_samples = of_runs(values, "dds.samples");
  for (auto& [quantity, by_run] : values) {
    const record::ScalarKind* const kind = record::scalar_kind_of(quantity.name);
    if (kind == nullptr || !kind->is_open) continue;
    const bool is_of_messages = kind->name.starts_with("topics.");
    const bool is_of_samples = kind->name.starts_with("dds.");
    const auto counts = [&](std::size_t run) {
      return (!is_of_messages || with_messages.contains(run)) &&
             (!is_of_samples || with_samples.contains(run));
    };
    for (const std::vector<std::size_t>& equal : parts) complete(by_run, equal, counts);
  }
}

std::string short_key(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? key : key.substr(dot + 1);
}

std::string Experiment::label(std::size_t point) const {
  std::string text;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i].same_as) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", short_key(factors[i].key),
                        points[point].levels[i].text);
  }
  return text.empty() ? "all runs" : text;
}

std::optional<std::size_t> Experiment::factor(const std::string& key) const {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i].key == key) return i;
    if (!factors[i].key.ends_with("." + key)) continue;
    if (found) return std::nullopt;  // ambiguous
    found = i;
  }
  return found;
}

std::string Experiment::axis_label(std::size_t factor) const {
  const Factor& of = factors[factor];
  const std::string name = short_key(of.key);
  return of.unit.empty() || of.unit == "1" ? name : fmt::format("{} / {}", name, of.unit);
}

void Experiment::add_scalars(std::size_t run, const std::vector<record::Scalar>& scalars) {
  for (const record::Scalar& scalar : scalars) {
    units[scalar.name] = scalar.unit;
    values[{scalar.name, scalar.agent}][run] = scalar.value;
  }
}

void Experiment::add_series(std::size_t run, const std::vector<record::Series>& recorded) {
  for (const record::Series& one : recorded) {
    units.emplace(one.name, one.unit);
    series[{one.name, one.agent}][run] = one.points;
  }
}

void Experiment::add_bins(std::size_t run, const std::vector<record::Bins>& all) {
  for (const record::Bins& one : all) {
    units.emplace(one.name, one.unit);
    bins[{one.name, one.agent}][run] = one.bins;
  }
}

}  // namespace results::report
