#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <tuple>

#include "results/record/run_reader.h"
#include "results/report/experiment.h"
#include "results/report/run_result.h"

namespace results::report {
namespace {

using AllSettings = std::map<std::string, std::string>;

struct ReadRun {
  std::string folder;
  AllSettings settings;  ///< All settings, including the scenario's name.
  AllSettings compared;  ///< The settings that distinguish points.
  std::uint64_t seed = 0;
  std::string fingerprint;  ///< "": written by a version without fingerprints.
  std::string ending;
  bool is_complete = false;
};

ReadRun read_head(record::RunReader& reader) {
  ReadRun run;
  run.folder = reader.folder().string();
  record::Statement rows = reader.query("SELECT key, value FROM settings");
  while (rows.next()) run.settings[rows.text(0)] = rows.text(1);
  run.settings["version of baraka"] = reader.value("version");
  run.settings.try_emplace("name", reader.value("scenario"));
  run.settings.try_emplace("radio.profile", reader.value("profile"));
  run.compared = run.settings;
  std::erase_if(run.compared, [](const auto& setting) {
    return setting.first == "seed" || sim::scenario::is_for_the_report_only(setting.first);
  });
  run.seed = std::strtoull(reader.value("seed").c_str(), nullptr, 10);
  run.fingerprint = reader.value("fingerprint");
  run.ending = reader.value("result");
  static const std::set<std::string> no_ends = {"running", "failed", "interrupted", "not started"};
  run.is_complete = !no_ends.contains(run.ending);
  return run;
}

std::string value_of(const AllSettings& settings, const std::string& key) {
  const auto found = settings.find(key);
  return found == settings.end() ? "-" : found->second;
}

/// Keys whose values differ: names and versions first, then profiles, programs and algorithms,
/// which change several settings at once; options of the command line last.
std::vector<std::string> differing_keys(const std::vector<AllSettings>& points) {
  std::set<std::string> keys;
  for (const AllSettings& settings : points) {
    for (const auto& [key, value] : settings) keys.insert(key);
  }
  std::vector<std::string> differing;
  for (const std::string& key : keys) {
    const std::string first = value_of(points.front(), key);
    const auto is_same = [&](const AllSettings& one) { return value_of(one, key) == first; };
    if (!std::ranges::all_of(points, is_same)) differing.push_back(key);
  }
  const auto rank = [](const std::string& key) {
    if (key == "name" || key == "version of baraka") return 0;
    if (key.starts_with("--")) return 3;
    return key.ends_with("profile") || key.ends_with("program") || key.ends_with("algorithm") ? 1
                                                                                              : 2;
  };
  std::ranges::stable_sort(differing, {}, rank);
  return differing;
}

/// A number for each point; points with the same value of the key have the same number.
std::vector<std::size_t> partition(const std::vector<AllSettings>& points, const std::string& key) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> parts;
  parts.reserve(points.size());
  for (const AllSettings& settings : points) {
    parts.push_back(numbers.emplace(value_of(settings, key), numbers.size()).first->second);
  }
  return parts;
}

/// Splits "0.3 m/s" into number and unit. If it is not a number, the unit is the whole text.
std::pair<std::optional<double>, std::string> split(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || (*end != '\0' && *end != ' ')) return {std::nullopt, text};
  return {number, *end == ' ' ? std::string(end + 1) : std::string()};
}

void add_factor(Experiment& experiment, const std::string& key,
                const std::vector<AllSettings>& points) {
  Experiment::Factor factor{.key = key, .unit = split(value_of(points.front(), key)).second};
  const auto is_number = [&](const AllSettings& settings) {
    const auto [number, unit] = split(value_of(settings, key));
    return number && unit == factor.unit;
  };
  const bool is_numeric = std::ranges::all_of(points, is_number);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string text = value_of(points[i], key);
    experiment.points[i].levels.push_back(
        {text, is_numeric ? split(text).first : std::optional<double>()});
  }
  if (!is_numeric) factor.unit.clear();
  experiment.factors.push_back(std::move(factor));
}

void add_factors(Experiment& experiment, const std::vector<AllSettings>& points) {
  std::map<std::vector<std::size_t>, std::size_t> seen;
  for (const std::string& key : differing_keys(points)) {
    const std::size_t place = experiment.factors.size();
    const auto [first, is_new] = seen.emplace(partition(points, key), place);
    add_factor(experiment, key, points);
    if (!is_new) experiment.factors.back().same_as = first->second;
  }
}

void read_measurements(Experiment& experiment, std::size_t run, record::RunReader& reader) {
  experiment.add_scalars(run, record::scalars_of(reader));
  experiment.add_series(run, record::series_of(reader));
  experiment.add_bins(run, record::bins_of(reader));
}

}  // namespace

Experiment experiment_of(const std::vector<std::filesystem::path>& folders) {
  Experiment experiment;
  std::vector<AllSettings> points;
  std::map<std::tuple<std::size_t, std::uint64_t, std::string>, std::size_t> seen;
  for (const std::filesystem::path& folder : folders) {
    record::RunReader reader(folder);
    const ReadRun run = read_head(reader);
    if (!run.is_complete) {
      experiment.left_out.push_back(fmt::format("{}: {}", run.folder, run.ending));
      continue;
    }
    if (experiment.requests.empty()) experiment.requests = sim::scenario::requests_in(run.settings);
    if (experiment.observables.empty())
      experiment.observables = sim::scenario::observables_in(run.settings);
    auto place = std::ranges::find(points, run.compared);
    if (place == points.end()) {
      points.push_back(run.compared);
      experiment.points.emplace_back();
      place = std::prev(points.end());
    }
    const auto point = static_cast<std::size_t>(place - points.begin());
    const auto [first, is_new] =
        seen.try_emplace({point, run.seed, run.fingerprint}, experiment.runs.size());
    if (!is_new && !run.fingerprint.empty()) {
      experiment.left_out.push_back(
          fmt::format("{}: same run as {}", run.folder, experiment.runs[first->second].name));
      continue;
    }
    experiment.points[point].runs.push_back(experiment.runs.size());
    experiment.runs.push_back({run.folder, point, run.seed});
    read_measurements(experiment, experiment.runs.size() - 1, reader);
  }
  if (points.size() > 1) add_factors(experiment, points);
  experiment.complete_open_counts();
  return experiment;
}

}  // namespace results::report
