#include "results/report/paired_differences.h"

#include <utility>

namespace results::report {
namespace {

/// Values of the runs of the first point and of `point` that have equal seeds, as pairs, in the
/// order of the first point's runs.
std::vector<std::pair<double, double>> pairs_of(const Experiment& experiment, const Selected& of,
                                                std::size_t point) {
  std::vector<std::pair<double, double>> pairs;
  for (const std::size_t first : experiment.points.front().runs) {
    for (const std::size_t second : experiment.points[point].runs) {
      if (experiment.runs[first].seed != experiment.runs[second].seed) continue;
      if (of.values.contains(first) && of.values.contains(second)) {
        pairs.emplace_back(of.values.at(first), of.values.at(second));
        break;
      }
    }
  }
  return pairs;
}

}  // namespace

std::vector<PairedDifference> paired_differences(const Experiment& experiment,
                                                 const sim::scenario::PlotRequest& asked) {
  const sim::scenario::PlotRequest request = with_full_name(experiment, asked);
  const auto of = select(experiment, request.plot, request.agent);
  std::vector<PairedDifference> all;
  for (std::size_t point = 1; of && point < experiment.points.size(); ++point) {
    std::vector<double> first;
    std::vector<double> second;
    for (const auto& [a, b] : pairs_of(experiment, *of, point)) {
      first.push_back(a);
      second.push_back(b);
    }
    const auto pairs = statistics::compare_pairs(first, second, of->support);
    if (pairs) all.push_back({experiment.label(point), *pairs});
  }
  return all;
}

}  // namespace results::report
