#include "results/fleet/fleet_answer.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <span>

#include "results/fleet/fleet_cause.h"
#include "results/statistics/clustered_quantile.h"

namespace results::fleet {
namespace {

using statistics::Support;

/// None: no run has the quantity.
template <class Get>
std::optional<Estimate> estimate(const std::vector<FleetRun>& runs, Support::Kind kind,
                                 const Get& get) {
  std::vector<double> values;
  for (const FleetRun& run : runs) {
    if (const std::optional<double> value = get(run)) values.push_back(*value);
  }
  const auto moments = statistics::moments(values);
  if (!moments) return std::nullopt;
  return Estimate{moments->mean, statistics::mean_interval(values, Support{kind}), values.size()};
}

using MeasureIn = std::function<const SampleMeasure*(const FleetRun&)>;

/// In one run, robots and topics keep their places in time to each other, and whether a small
/// sample waits behind a large one is decided for all of them: the median of one run can be either
/// time, and the mean of such medians neither.
std::optional<Estimate> latency_of(const std::vector<FleetRun>& runs, const MeasureIn& in,
                                   double p) {
  std::vector<std::span<const double>> clusters;
  for (const FleetRun& run : runs) {
    if (const SampleMeasure* const measure = in(run)) clusters.emplace_back(measure->latencies);
  }
  const auto found = statistics::clustered_quantile(clusters, p);
  if (!found) return std::nullopt;
  return Estimate{found->value, found->interval, found->clusters};
}

SampleAnswer samples_of(const std::vector<FleetRun>& runs, const MeasureIn& in) {
  SampleAnswer answer;
  const auto of = [&](Support::Kind kind, const auto& get) {
    return estimate(runs, kind, [&](const FleetRun& run) -> std::optional<double> {
      const SampleMeasure* const measure = in(run);
      return measure == nullptr ? std::nullopt : get(*measure);
    });
  };
  constexpr auto kShare = Support::Kind::kShare;
  constexpr auto kTime = Support::Kind::kNotNegative;
  answer.delivered = of(kShare, [](const SampleMeasure& m) { return m.delivered_share(); });
  answer.first_try = of(kShare, [](const SampleMeasure& m) -> std::optional<double> {
    if (m.samples == 0) return std::nullopt;
    return static_cast<double>(m.first_try) / static_cast<double>(m.samples);
  });
  answer.p50 = latency_of(runs, in, 0.50);
  answer.p95 = latency_of(runs, in, 0.95);
  answer.p99 = latency_of(runs, in, 0.99);
  answer.age = of(kTime, [](const SampleMeasure& m) { return m.age95; });
  answer.discovered = of(kTime, [](const SampleMeasure& m) { return m.discovered; });
  for (const FleetRun& run : runs) {
    const SampleMeasure* const measure = in(run);
    ++answer.runs;
    if (measure == nullptr) continue;
    answer.pairs += measure->pairs;
    answer.silent += measure->silent;
    answer.samples += measure->samples;
    answer.repaired += measure->repaired;
    answer.under_way += measure->under_way;
    if (measure->samples == 0 && measure->pairs > 0 && measure->silent == 0) ++answer.unsent;
    for (const auto& [why, count] : measure->lost) answer.lost[why] += count;
  }
  return answer;
}

void add_topics(const std::vector<FleetRun>& runs, CaseAnswer& answer) {
  for (const FleetRun& run : runs) {
    for (const auto& [group, measure] : run.topics) answer.topics.try_emplace(group);
  }
  for (auto& topic : answer.topics) {
    topic.second = samples_of(runs, [&topic](const FleetRun& run) -> const SampleMeasure* {
      const auto found = run.topics.find(topic.first);
      return found == run.topics.end() ? nullptr : &found->second;
    });
  }
}

/// A use that a run does not have is 0 there: its record holds all transmissions.
void add_air(const std::vector<FleetRun>& runs, CaseAnswer& answer) {
  for (const FleetRun& run : runs) {
    for (const auto& [what, share] : run.air) answer.air.try_emplace(what);
  }
  for (auto& use : answer.air) {
    use.second = *estimate(runs, Support::Kind::kNotNegative,
                           [&use](const FleetRun& run) -> std::optional<double> {
                             const auto found = run.air.find(use.first);
                             return found == run.air.end() ? 0.0 : found->second;
                           });
  }
}

void add_radios(const std::vector<FleetRun>& runs, CaseAnswer& answer) {
  answer.busy = estimate(runs, Support::Kind::kShare, [](const FleetRun& run) { return run.busy; });
  answer.backlogged =
      estimate(runs, Support::Kind::kShare, [](const FleetRun& run) { return run.backlogged; });
  double most = -1;
  double fullest = -1;
  for (const FleetRun& run : runs) {
    const double part = 1.0 / static_cast<double>(runs.size());
    answer.handovers += part * static_cast<double>(run.handovers);
    answer.unassociated += part * static_cast<double>(run.unassociated);
    answer.wall_s += part * run.wall_s;
    if (run.busy.value_or(0) > most) answer.busiest = run.busiest;
    most = std::max(most, run.busy.value_or(0));
    if (run.backlogged.value_or(0) > fullest) answer.most_backlogged = run.most_backlogged;
    fullest = std::max(fullest, run.backlogged.value_or(0));
    answer.ended_s = std::min(answer.ended_s.value_or(run.simulated_s), run.simulated_s);
  }
}

int count_of(const FleetLine& line) { return line.largest().value_or(0); }

/// Use of the air with that many robots; with the least number if there is no such case.
double air_with(const FleetLine& line, int robots) {
  const auto found = std::ranges::find_if(
      line.cases, [&](const CaseAnswer& one) { return one.which.robots == robots; });
  return air_of(found == line.cases.end() ? line.cases.front() : *found);
}

/// Whether the first of two cases that do not hold is nearer to it.
bool fails_less(const CaseAnswer& a, const CaseAnswer& b) {
  if (a.misses.size() != b.misses.size()) return a.misses.size() < b.misses.size();
  const auto delivered = [](const CaseAnswer& one) {
    double sum = 0;
    for (const SampleAnswer& need : one.needs) sum += need.delivered ? need.delivered->value : 0;
    return sum;
  };
  return delivered(a) > delivered(b);
}

}  // namespace

std::optional<int> FleetLine::largest() const {
  std::optional<int> most;
  for (const CaseAnswer& one : cases) {
    if (!one.holds()) break;
    most = one.which.robots;
  }
  return most;
}

const CaseAnswer* FleetLine::first_miss() const {
  const auto found =
      std::ranges::find_if(cases, [](const CaseAnswer& one) { return !one.holds(); });
  return found == cases.end() ? nullptr : &*found;
}

std::size_t FleetLine::runs() const {
  std::size_t sum = 0;
  for (const CaseAnswer& one : cases) sum += one.runs;
  return sum;
}

std::size_t FleetLine::failed() const {
  std::size_t sum = 0;
  for (const CaseAnswer& one : cases) sum += one.failed;
  return sum;
}

CaseAnswer answer_of(const FleetFile& fleet, const Case& which, const std::vector<FleetRun>& runs,
                     std::size_t failed) {
  CaseAnswer answer;
  answer.which = which;
  answer.runs = runs.size();
  answer.failed = failed;
  for (std::size_t i = 0; i < fleet.needs.size(); ++i) {
    answer.needs.push_back(samples_of(runs, [i](const FleetRun& run) { return &run.needs[i]; }));
  }
  add_topics(runs, answer);
  add_air(runs, answer);
  add_radios(runs, answer);
  if (!runs.empty()) answer.misses = misses_of(fleet, answer);
  return answer;
}

std::vector<FleetLine> lines_of(std::vector<CaseAnswer> cases) {
  std::vector<FleetLine> lines;
  for (CaseAnswer& one : cases) {
    const auto& [radio, site, profile, robots] = one.which;
    const bool is_new = lines.empty() || lines.back().radio != radio || lines.back().site != site ||
                        lines.back().profile != profile;
    if (is_new) lines.push_back({radio, site, profile, {}});
    lines.back().cases.push_back(std::move(one));
  }
  return lines;
}

std::vector<const FleetLine*> ranked(const std::vector<FleetLine>& lines, std::size_t radio,
                                     std::size_t site) {
  std::vector<const FleetLine*> some;
  for (const FleetLine& line : lines) {
    if (line.radio == radio && line.site == site && line.runs() > 0) some.push_back(&line);
  }
  std::ranges::stable_sort(some, [](const FleetLine* a, const FleetLine* b) {
    if (count_of(*a) != count_of(*b)) return count_of(*a) > count_of(*b);
    if (count_of(*a) == 0) return fails_less(a->cases.front(), b->cases.front());
    return air_with(*a, count_of(*a)) < air_with(*b, count_of(*a));
  });
  return some;
}

double air_of(const CaseAnswer& one) {
  double sum = 0;
  for (const auto& [what, share] : one.air) sum += share.value;
  return sum;
}

}  // namespace results::fleet
