#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace results::campaign {

/// A key of the scenario that the campaign varies.
struct Factor {
  std::string key;   ///< Dotted path, as for --set.
  std::string unit;  ///< Unit of the levels' numbers; "": none.
};

/// The value of one factor.
struct Level {
  std::string text;              ///< As in a scenario file, with its unit.
  std::optional<double> number;  ///< In the factor's unit; none: not a number.
  /// The point does not set the key: `text` is the value in its scenario; "": it has no such key.
  bool is_default = false;
  bool operator==(const Level&) const = default;
};

/// One point: a combination of levels.
struct PointRow {
  int point = 1;              ///< From 1.
  std::string label;          ///< For display: "speed=0.3 m/s"; "" if nothing is varied.
  std::string scenario;       ///< The resolved scenario.
  std::vector<Level> levels;  ///< In the order of the factors.
};

/// One planned run.
struct RunPlan {
  std::int64_t run = 0;  ///< From 1.
  int point = 1;
  int replication = 1;  ///< Counted from 1 at each point.
  std::uint64_t seed = 0;
};

enum class RunState : std::uint8_t { kWaiting, kRunning, kDone, kFailed };

/// "waiting", "running", "done", "failed".
std::string_view name_of(RunState state);

/// A row of the table `runs`.
struct RunRow {
  RunPlan plan;
  RunState state = RunState::kWaiting;
  std::string result;  ///< "": the run has not ended.
  /// None: the run has not ended, has failed, or was ended by `until`.
  std::optional<bool> expectations_met;
  std::string error;  ///< Why the run failed.
  std::string fingerprint;
  std::optional<double> simulated_s, wall_s, user_s;
  std::string host;
  int attempts = 0;
  std::string started, ended;  ///< UTC, "2026-11-22T20:31:14Z".
  std::string folder;          ///< Relative to the campaign's folder; "": not kept.
};

/// An observable of one agent or of the whole run.
struct MeasuredBy {
  std::string name, unit;
  std::string agent;  ///< "": the whole run.
};

struct Measurement {
  MeasuredBy observable;
  std::optional<double> value;
};

/// An observable's values over time.
struct MeasuredSeries {
  MeasuredBy observable;
  std::vector<std::pair<double, double>> points;  ///< s of simulated time, value.
};

struct MeasuredBin {
  double lower = 0, upper = 0;
  std::int64_t count = 0;
};

struct MeasuredHistogram {
  MeasuredBy observable;
  std::vector<MeasuredBin> bins;
};

/// All measurements of a run.
struct Measured {
  std::vector<Measurement> measurements;
  std::vector<MeasuredSeries> series;
  std::vector<MeasuredHistogram> histograms;
};

}  // namespace results::campaign
