#include "results/report/experiment_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "results/report/paired_differences.h"
#include "results/report/plot_parts.h"
#include "results/report/report_format.h"
#include "results/report/text_table.h"
#include "results/statistics/quantile.h"

namespace results::report {
namespace {

/// Keys of the other factors that change between the same points as this one; "": none.
std::string changing_with(const Experiment& experiment, std::size_t factor) {
  std::string keys;
  for (const Experiment::Factor& one : experiment.factors) {
    if (one.same_as == factor) keys += (keys.empty() ? "" : ", ") + one.key;
  }
  return keys;
}

std::string head_text(const Experiment& experiment) {
  std::string text = fmt::format("Experiment: {} setting{}, {} complete run{}",
                                 experiment.points.size(), experiment.points.size() == 1 ? "" : "s",
                                 experiment.runs.size(), experiment.runs.size() == 1 ? "" : "s");
  if (!experiment.real_time.empty())
    text += fmt::format("\n  in real time ({}): runs of equal seeds differ", experiment.real_time);
  for (const std::string& run : experiment.left_out) text += "\n  left out: " + run;
  for (std::size_t i = 0; i < experiment.factors.size(); ++i) {
    if (experiment.factors[i].same_as) continue;
    std::set<std::string> levels;
    for (const Experiment::Point& point : experiment.points) levels.insert(point.levels[i].text);
    const std::string others = changing_with(experiment, i);
    text += fmt::format("\n  {}: {} values{}", experiment.factors[i].key, levels.size(),
                        others.empty() ? "" : " (changes together with " + others + ")");
  }
  return text + "\n";
}

std::string significant(double value) { return fmt::format("{:.6g}", value); }

std::string optional_text(const std::optional<double>& value) {
  return value ? significant(*value) : "-";
}

std::string number_text(double value, Digits digits) {
  return digits == Digits::kExact ? fmt::format("{}", value) : significant(value);
}

/// The table cells of one mark, without the label of its curve.
std::vector<std::string> cells_of(const Plot::Mark& mark, const Plot& plot, Digits digits) {
  const auto text = [digits](double value) { return number_text(value, digits); };
  if (plot.kind == sim::scenario::PlotKind::kHistogram) {
    return {text(mark.x - mark.width / 2), text(mark.x + mark.width / 2),
            std::to_string(mark.count)};
  }
  const bool is_category = !plot.categories.empty();
  return {is_category ? plot.categories.at(static_cast<std::size_t>(mark.x)) : text(mark.x),
          std::to_string(mark.count),
          text(mark.y),
          mark.interval ? text(mark.interval->low) : "-",
          mark.interval ? text(mark.interval->high) : "-",
          mark.count > 1 ? text(mark.sd) : "-"};
}

}  // namespace

std::string quantities_text(const Experiment& experiment) {
  TextTable table({"quantity", "unit", "runs", "mean", "95 % low", "high", "sd", "median"});
  std::vector<std::size_t> all_runs(experiment.runs.size());
  std::iota(all_runs.begin(), all_runs.end(), std::size_t{0});
  for (const auto& [quantity, by_run] : experiment.values) {
    if (!quantity.agent.empty()) continue;
    const Sample sample = sample_of(all_runs, *select(experiment, quantity.name, ""));
    const auto of = statistics::moments(sample.values);
    const auto interval = statistics::mean_interval(sample.values, sample.support);
    table.add_row({quantity.name, experiment.units.at(quantity.name), std::to_string(of->count),
                   significant(of->mean), interval ? significant(interval->low) : "-",
                   interval ? significant(interval->high) : "-",
                   of->count > 1 ? significant(of->sd) : "-",
                   significant(*statistics::quantile(sample.values, 0.5))});
  }
  return "Quantities of a run: mean over the runs that have the quantity, with its 95 % interval:\n"
         "Student's t, or the score interval for shares, counts and quantities that are never "
         "negative\n(docs/statistics.md)\n" +
         table.text();
}

std::vector<std::vector<std::string>> plot_rows(const Plot& plot, Digits digits) {
  const bool has_curves = plot.curves.size() > 1;
  std::vector<std::vector<std::string>> rows = {
      plot.kind == sim::scenario::PlotKind::kHistogram
          ? std::vector<std::string>{"from", "to", "count"}
          : std::vector<std::string>{plot.x_label.empty() ? "setting" : plot.x_label, "runs",
                                     "mean", "95 % low", "high", "sd"}};
  if (has_curves) rows.front().insert(rows.front().begin(), "curve");
  for (const Plot::Curve& curve : plot.curves) {
    for (const Plot::Mark& mark : curve.marks) {
      std::vector<std::string> row = cells_of(mark, plot, digits);
      if (has_curves) row.insert(row.begin(), curve.label);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string plot_text(const Plot& plot) {
  constexpr std::size_t kMostRows = 60;
  const auto rows = plot_rows(plot);
  TextTable table;
  for (std::size_t i = 0; i < std::min(rows.size(), kMostRows + 1); ++i) table.add_row(rows[i]);
  std::string text =
      fmt::format("{}: {}\n{}", plot.title,
                  plot.kind == sim::scenario::PlotKind::kHistogram
                      ? plot.x_label
                      : plot.y_label + ", mean over runs and its 95 % interval" +
                            (plot.interval == sim::scenario::IntervalKind::kBootstrap
                                 ? std::string(" (BCa bootstrap)")
                                 : fmt::format(" ({})", name_of_interval(plot.support))),
                  table.text());
  if (rows.size() > kMostRows + 1) {
    text += fmt::format("… {} more rows: baraka report DIR --figure {} -o FILE.csv\n",
                        rows.size() - kMostRows - 1, plot.name);
  }
  for (const std::string& note : plot.notes) text += "note: " + note + "\n";
  return text;
}

std::string pairs_text(const Experiment& experiment, const sim::scenario::PlotRequest& request) {
  const std::vector<PairedDifference> differences = paired_differences(experiment, request);
  if (differences.empty()) return {};
  TextTable table({"setting", "pairs", "difference", "95 % low", "high", "p", "correlation"});
  for (const auto& [setting, pairs] : differences) {
    table.add_row({setting, std::to_string(pairs.difference.count),
                   significant(pairs.difference.mean), significant(pairs.interval.low),
                   significant(pairs.interval.high), optional_text(pairs.p),
                   optional_text(pairs.correlation)});
  }
  return fmt::format("{}: difference to {}, runs with equal seeds in pairs\n{}",
                     with_full_name(experiment, request).plot, experiment.label(0), table.text());
}

std::string resamples_csv(const Experiment& experiment) {
  std::set<std::size_t> counts;
  for (const Experiment::Point& point : experiment.points) counts.insert(point.runs.size());
  std::string text;
  for (const std::size_t count : counts) {
    if (count > 1) text += resamples_of(count).csv();
  }
  return text;
}

std::string experiment_section(const Experiment& experiment) {
  std::string text = head_text(experiment);
  const std::vector<sim::scenario::PlotRequest> requests = requests_of(experiment);
  if (requests.empty() && experiment.points.size() > 1) {
    text += "\nno quantity that is shown by default differs; --figure NAME shows any of them\n";
  }
  for (const sim::scenario::PlotRequest& request : requests) {
    text += "\n" + plot_text(make_plot(experiment, request));
    if (const std::string pairs = pairs_text(experiment, request); !pairs.empty()) {
      text += "\n" + pairs;
    }
  }
  if (experiment.points.size() == 1 && experiment.runs.size() > 1) {
    text += "\n" + quantities_text(experiment);
    if (experiment.runs.size() < statistics::kFewestRuns) {
      text +=
          fmt::format("note: only {} runs: too few to trust an interval; at least {} are needed\n",
                      experiment.runs.size(), statistics::kFewestRuns);
    }
  }
  return text;
}

}  // namespace results::report
