#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "results/report/plot_parts.h"

namespace results::report {
namespace {

/// More curves than this cannot be told apart and are drawn as one cloud of marks without lines.
constexpr std::size_t kMostCurves = 12;

/// Texts in order of first appearance; place() gives a text's index.
struct Categories {
  std::vector<std::string> texts;
  double place(const std::string& text) {
    const auto found = std::ranges::find(texts, text);
    const auto place = found - texts.begin();
    if (found == texts.end()) texts.push_back(text);
    return static_cast<double>(place);
  }
};

bool is_numeric(const Experiment& experiment, std::size_t factor) {
  return std::ranges::all_of(experiment.points, [factor](const Experiment::Point& point) {
    return point.levels[factor].number.has_value();
  });
}

/// The factors in which the curves differ, the requested one first.
std::vector<std::size_t> others(const Experiment& experiment, std::size_t versus,
                                const std::optional<std::size_t>& by) {
  std::vector<std::size_t> factors;
  if (by && *by != versus) factors.push_back(*by);
  for (std::size_t i = 0; i < experiment.factors.size(); ++i) {
    const bool is_shown = experiment.first_like(i) == experiment.first_like(versus) ||
                          (by && experiment.first_like(i) == experiment.first_like(*by));
    if (!experiment.factors[i].same_as && !is_shown) factors.push_back(i);
  }
  return factors;
}

std::string label_of(const Experiment& experiment, const Experiment::Point& point,
                     const std::vector<std::size_t>& factors) {
  std::string text;
  for (const std::size_t factor : factors) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                        short_key(experiment.factors[factor].key), point.levels[factor].text);
  }
  return text;
}

/// Sorts curves by their levels, as far as these are numbers.
void sort_curves(std::vector<std::pair<std::vector<Experiment::Level>, Plot::Curve>>& curves) {
  const auto before = [](const Experiment::Level& a, const Experiment::Level& b) {
    return a.number && b.number ? *a.number < *b.number : false;
  };
  std::ranges::stable_sort(curves, [&](const auto& a, const auto& b) {
    return std::ranges::lexicographical_compare(a.first, b.first, before);
  });
}

void join_into_a_cloud(Plot& plot) {
  Plot::Curve cloud{fmt::format("{} settings", plot.curves.size()), {}};
  for (Plot::Curve& curve : plot.curves) {
    cloud.marks.insert(cloud.marks.end(), curve.marks.begin(), curve.marks.end());
  }
  plot.notes.push_back(
      fmt::format("each mark is a setting of its own: they differ in {}, too", plot.curves_are));
  plot.curves_are = "no line: each mark is a setting of its own";
  plot.curves = {std::move(cloud)};
}

std::string short_keys(const Experiment& experiment, const std::vector<std::size_t>& factors) {
  std::string text;
  for (const std::size_t factor : factors) {
    text += (text.empty() ? "" : ", ") + short_key(experiment.factors[factor].key);
  }
  return text;
}

}  // namespace

Plot::Mark mark_of(const Sample& sample, sim::scenario::IntervalKind interval) {
  Plot::Mark mark;
  const std::vector<double>& values = sample.values;
  const auto moments = statistics::moments(values);
  if (!moments) return mark;
  mark.y = moments->mean;
  mark.sd = moments->sd;
  mark.count = moments->count;
  mark.interval = statistics::mean_interval(values, sample.support);
  if (interval == sim::scenario::IntervalKind::kBootstrap && mark.count > 1) {
    const statistics::Resamples resamples = resamples_of(mark.count);
    const auto sorted = statistics::bootstrap(values, resamples, statistics::mean_of);
    const auto bca = statistics::bca_interval(values, sorted, statistics::mean_of);
    mark.interval = bca ? *bca : statistics::percentile_interval(sorted);
  }
  return mark;
}

statistics::Resamples resamples_of(std::size_t count) {
  return {count, kResamples, 1, fmt::format("report/{}", count)};
}

void add_points(Plot& plot, const Experiment& experiment, const Selected& of,
                const std::optional<std::size_t>& versus, const std::optional<std::size_t>& by) {
  if (!versus) {
    plot.categories = {"all runs"};
    plot.curves = {{"", {mark_of(sample_of(experiment.points.at(0).runs, of), plot.interval)}}};
    return;
  }
  const std::vector<std::size_t> curve_factors = others(experiment, *versus, by);
  plot.curves_are = short_keys(experiment, curve_factors);
  const bool has_numbers = is_numeric(experiment, *versus);
  // Levels shown as text contain their units.
  plot.x_label =
      has_numbers ? experiment.axis_label(*versus) : short_key(experiment.factors[*versus].key);
  Categories categories;
  std::vector<std::pair<std::vector<Experiment::Level>, Plot::Curve>> curves;
  for (const Experiment::Point& point : experiment.points) {
    Plot::Mark mark = mark_of(sample_of(point.runs, of), plot.interval);
    const Experiment::Level& level = point.levels[*versus];
    mark.x = has_numbers ? *level.number : categories.place(level.text);
    mark.x_text = level.text;
    if (mark.count == 0) continue;
    std::vector<Experiment::Level> key;
    key.reserve(curve_factors.size());
    for (const std::size_t factor : curve_factors) key.push_back(point.levels[factor]);
    auto curve = std::ranges::find(curves, key, &decltype(curves)::value_type::first);
    if (curve == curves.end()) {
      curves.push_back({key, {label_of(experiment, point, curve_factors), {}}});
      curve = std::prev(curves.end());
    }
    curve->second.marks.push_back(std::move(mark));
  }
  sort_curves(curves);
  for (auto& [key, curve] : curves) plot.curves.push_back(std::move(curve));
  if (plot.curves.size() > kMostCurves) join_into_a_cloud(plot);
  for (Plot::Curve& curve : plot.curves) std::ranges::stable_sort(curve.marks, {}, &Plot::Mark::x);
  if (!has_numbers) plot.categories = categories.texts;
}

}  // namespace results::report
