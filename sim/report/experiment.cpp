#include "sim/report/experiment.h"

#include <fmt/format.h>

namespace sim::report {

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
    if (found) return std::nullopt;  // not enough to tell them apart
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

void Experiment::add_series(std::size_t run, const std::vector<record::Series>& series) {
  for (const record::Series& one : series) {
    units.emplace(one.name, one.unit);
    courses[{one.name, one.agent}][run] = one.points;
  }
}

void Experiment::add_bins(std::size_t run, const std::vector<record::Bins>& all) {
  for (const record::Bins& one : all) {
    units.emplace(one.name, one.unit);
    bins[{one.name, one.agent}][run] = one.bins;
  }
}

}  // namespace sim::report
