#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace results::campaign {

/// A key of the scenario that is varied.
struct Factor {
  std::string key;   ///< Dotted path, as for --set.
  std::string unit;  ///< Of the levels' numbers; "" for none.
};

/// The value of one factor.
struct Level {
  std::string text;              ///< As in a scenario file, with its unit.
  std::optional<double> number;  ///< In the factor's unit; none: it is no number.
  /// The point does not set the key: `text` is what its scenario has; "": it has no such key.
  bool is_default = false;
  bool operator==(const Level&) const = default;
};

/// Settings that are compared with others.
struct PointRow {
  int point = 1;              ///< From 1.
  std::string label;          ///< For people: "speed=0.3 m/s"; "" if nothing is varied.
  std::string scenario;       ///< Resolved.
  std::vector<Level> levels;  ///< By factor.
};

/// One run that there is to do.
struct RunPlan {
  std::int64_t run = 0;  ///< From 1.
  int point = 1;
  int replication = 1;  ///< From 1 at each point.
  std::uint64_t seed = 0;
};

enum class RunState : std::uint8_t { kWaiting, kRunning, kDone, kFailed };

/// "waiting", "running", "done", "failed".
std::string_view name_of(RunState state);

/// A row of the table runs.
struct RunRow {
  RunPlan plan;
  RunState state = RunState::kWaiting;
  std::string result;                    ///< "": it has not ended.
  std::optional<bool> expectations_met;  ///< None: it did not end well.
  std::string error;                     ///< Why it failed.
  std::string fingerprint;
  std::optional<double> simulated_s, wall_s, user_s;
  std::string host;
  int attempts = 0;
  std::string started, ended;  ///< UTC, "2026-11-22T20:31:14Z".
  std::string folder;          ///< In the campaign's folder; "": not kept.
};

/// What was measured, and of whom.
struct MeasuredBy {
  std::string name, unit;
  std::string agent;  ///< "": the whole run.
};

struct Measurement {
  MeasuredBy observable;
  std::optional<double> value;
};

/// Values over time.
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

/// All that a run has measured.
struct Measured {
  std::vector<Measurement> measurements;
  std::vector<MeasuredSeries> series;
  std::vector<MeasuredHistogram> histograms;
};

}  // namespace results::campaign
