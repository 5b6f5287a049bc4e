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

/// Runs as an experiment: the settings that were compared (points), how often each was run with
/// other seeds, and what every run measured. Made from folders of results or from a campaign; runs
/// of different settings are never at the same point. Places in the vectors count from 0.
struct Experiment {
  /// A setting that is not the same at all points.
  struct Factor {
    std::string key;   ///< Dotted path, as for --set.
    std::string unit;  ///< Of the levels' numbers; "": none.
    /// Place of the first factor that changes between the same points: their effects cannot be told
    /// apart. None: this is the first.
    std::optional<std::size_t> same_as{};
  };
  /// The value of a factor.
  struct Level {
    std::string text;              ///< As in a file, with its unit.
    std::optional<double> number;  ///< In the factor's unit; none: it is no number.
    bool operator==(const Level&) const = default;
  };
  struct Point {
    std::vector<Level> levels;      ///< By factor.
    std::vector<std::size_t> runs;  ///< Complete ones.
  };
  /// One that came to an end of its own.
  struct Run {
    std::string name;  ///< Folder, or number in the campaign.
    std::size_t point = 0;
    std::uint64_t seed = 0;
  };
  struct Quantity {
    std::string name;
    std::string agent;  ///< "": of the run.
    auto operator<=>(const Quantity&) const = default;
  };
  using TimeSeries = std::vector<std::pair<double, double>>;  ///< Simulated time [s], value.
  template <class Value>
  using ByRun = std::map<Quantity, std::map<std::size_t, Value>>;

  std::vector<Factor> factors;
  std::vector<Point> points;
  std::vector<Run> runs;
  std::vector<std::string> left_out;         ///< Runs that failed, were broken off or are copies.
  std::map<std::string, std::string> units;  ///< Of quantities, by name; "1": a count or a share.
  ByRun<double> values;
  ByRun<TimeSeries> series;
  ByRun<std::vector<record::Bins::Bin>> bins;
  /// What its report shows; empty: what differs most.
  std::vector<sim::scenario::PlotRequest> requests;
  /// Names and patterns of `record: {observables: …}`.
  std::vector<std::string> observables{};
  std::string scenario;        ///< Of a campaign: the first point's, resolved, as YAML.
  std::string scenario_place;  ///< Where that stands, for messages: file, table and row.

  /// "speed 0.3 m/s, range 100 m": last parts of the keys, of those that change together the first;
  /// "all runs" if nothing is varied.
  std::string label(std::size_t point) const;
  /// None: no such factor. The last parts of a key will do where they are enough.
  std::optional<std::size_t> factor(const std::string& key) const;
  /// Place of the first factor that changes between the same points: itself, if it is the first.
  std::size_t first_like(std::size_t factor) const {
    return factors[factor].same_as.value_or(factor);
  }
  /// The factor as the label of an axis: "speed / m/s".
  std::string axis_label(std::size_t factor) const;

  /// Once all runs are there: of words that no run knows of before they come up (topics, states of
  /// controllers that declare none), a run has the count 0 if another one of the same controllers
  /// has a number.
  void complete_open_counts();

  void add_scalars(std::size_t run, const std::vector<record::Scalar>& scalars);
  void add_series(std::size_t run, const std::vector<record::Series>& recorded);
  void add_bins(std::size_t run, const std::vector<record::Bins>& all);
};

/// Of results. Factors: the settings that differ, names and profiles before others, options of the
/// command line last. A run whose point, seed and fingerprint are another's is a copy: left out.
/// @param folders  as found by find_results().
/// @throws std::runtime_error if one cannot be read.
Experiment experiment_of(const std::vector<std::filesystem::path>& folders);

/// Of a campaign, finished or under way: the runs that are done.
/// @param folder  holds `campaign.sqlite`.
/// @throws std::runtime_error if it cannot be read.
Experiment experiment_of_campaign(const std::filesystem::path& folder);

/// "speed" of "agents.robots.controller.parameters.speed".
std::string short_key(const std::string& key);

}  // namespace results::report
