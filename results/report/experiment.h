#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/record/scalars.h"
#include "sim/scenario/plot_request.h"

namespace results::report {

/// Runs as an experiment: the compared settings (points), the runs of each point with different
/// seeds, and the measurements of each run. Made from folders of results or from a campaign. All
/// runs of a point have the same settings. Indices into the vectors count from 0.
struct Experiment {
  /// A setting that differs between points.
  struct Factor {
    std::string key;   ///< Dotted path, as for --set.
    std::string unit;  ///< Unit of the levels' numbers; "": none.
    /// Index of the first factor that changes between the same points as this one; the effects of
    /// the two cannot be distinguished. None: this factor is the first.
    std::optional<std::size_t> same_as{};
  };
  /// The value of a factor.
  struct Level {
    std::string text;              ///< As in a scenario file, with its unit.
    std::optional<double> number;  ///< In the factor's unit; none: not a number.
    bool operator==(const Level&) const = default;
  };
  struct Point {
    std::vector<Level> levels;      ///< In the order of the factors.
    std::vector<std::size_t> runs;  ///< Complete runs.
  };
  /// A complete run: it was neither interrupted nor did it fail.
  struct Run {
    std::string name;  ///< Its folder, or its number in the campaign.
    std::size_t point = 0;
    std::uint64_t seed = 0;
  };
  struct Quantity {
    std::string name;
    std::string agent;  ///< "": the whole run.
    auto operator<=>(const Quantity&) const = default;
  };
  using TimeSeries = std::vector<std::pair<double, double>>;  ///< Simulated time [s], value.
  template <class Value>
  using ByRun = std::map<Quantity, std::map<std::size_t, Value>>;

  std::vector<Factor> factors;
  std::vector<Point> points;
  std::vector<Run> runs;
  std::vector<std::string> left_out;  ///< Runs that failed, were interrupted or are copies.
  /// Units of quantities by name; "1": a count or a share.
  std::map<std::string, std::string> units;
  ByRun<double> values;
  ByRun<TimeSeries> series;
  ByRun<std::vector<record::Bins::Bin>> bins;
  /// Requested plots; if empty, requests_of() chooses.
  std::vector<sim::scenario::PlotRequest> requests;
  /// Names and patterns of `record: {observables: …}`.
  std::vector<std::string> observables{};
  std::string scenario;        ///< Campaigns only: the first point's resolved scenario, as YAML.
  std::string scenario_place;  ///< Where it comes from, for messages: file, table and row.
  std::string real_time;       ///< Campaigns in real time only: their pace, "realtime:0.5".

  /// "speed 0.3 m/s, range 100 m": the last parts of the keys with their values; of factors that
  /// change together, only the first. "all runs" if nothing is varied.
  std::string label(std::size_t point) const;
  /// Index of a factor. @param key  its key, or the last parts of it if they are unique. None:
  /// there is no such factor.
  std::optional<std::size_t> factor(const std::string& key) const;
  /// Index of the first factor that changes between the same points; the factor itself if it is the
  /// first.
  std::size_t first_like(std::size_t factor) const {
    return factors[factor].same_as.value_or(factor);
  }
  /// The factor as the label of an axis: "speed / m/s".
  std::string axis_label(std::size_t factor) const;

  /// To be called after the last run was added. Some counted words are known only once they occur
  /// (topics; states of controllers that declare none): a run without such a word gets the count 0
  /// if another run with the same controllers has a count of it.
  void complete_open_counts();

  void add_scalars(std::size_t run, const std::vector<record::Scalar>& scalars);
  void add_series(std::size_t run, const std::vector<record::Series>& recorded);
  void add_bins(std::size_t run, const std::vector<record::Bins>& all);
};

/// An experiment from results. Factors are the settings that differ: names and profiles first,
/// options of the command line last. A run with the same point, seed and fingerprint as another is
/// a copy and is left out.
/// @param folders  as found by find_results().
/// @throws std::runtime_error if one cannot be read.
Experiment experiment_of(const std::vector<std::filesystem::path>& folders);

/// An experiment from the completed runs of a campaign, which may still be running.
/// @param folder  holds `campaign.sqlite`.
/// @throws std::runtime_error if it cannot be read.
Experiment experiment_of_campaign(const std::filesystem::path& folder);

/// "speed" of "agents.robots.controller.parameters.speed".
std::string short_key(const std::string& key);

}  // namespace results::report
