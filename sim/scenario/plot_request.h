#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/config/mapping.h"

namespace sim::scenario {

/// How a plot shows a quantity.
enum class PlotKind : std::uint8_t {
  kAutomatic,  ///< kPoints if any setting varies, else kTime, else kHistogram.
  kPoints,     ///< For each setting the mean over its runs with its interval, versus a setting.
  kTable,      ///< The same as a table only.
  kHistogram,  ///< Distribution of the values.
  kTime,       ///< Mean over runs with its interval, versus simulated time.
};

inline constexpr std::array<hal::files::config::Option<PlotKind>, 5> kPlotKinds{
    {{"automatic", PlotKind::kAutomatic},
     {"points", PlotKind::kPoints},
     {"table", PlotKind::kTable},
     {"histogram", PlotKind::kHistogram},
     {"time", PlotKind::kTime}}};
std::string_view name_of(PlotKind kind);

/// Kind of confidence interval of the mean over runs.
enum class IntervalKind : std::uint8_t { kStudent, kBootstrap };

inline constexpr std::array<hal::files::config::Option<IntervalKind>, 2> kIntervalKinds{
    {{"student", IntervalKind::kStudent}, {"bootstrap", IntervalKind::kBootstrap}}};

/// One entry of `report:`.
struct PlotRequest {
  std::string plot{};    ///< Name of the quantity.
  std::string versus{};  ///< Key of the setting on the x axis; empty: the first that varies.
  std::string by{};      ///< Key of the setting with a curve per value; empty: all others.
  /// Name of an agent; empty: value of the run, or mean over the agents that have it.
  std::string agent{};
  PlotKind as = PlotKind::kAutomatic;
  IntervalKind interval = IntervalKind::kStudent;
};

/// The entries as stored in the table `settings` of a result ("report.0.plot" …).
std::vector<PlotRequest> requests_in(const std::map<std::string, std::string>& settings);

/// Names in `record: {observables: …}`, from the same table or from a resolved scenario
/// (sim::scenario::resolved_yaml()).
std::vector<std::string> observables_in(const std::map<std::string, std::string>& settings);
std::vector<std::string> observables_of(const std::string& resolved);

/// Whether a setting does not affect a run: `report`, `compare`. Runs that differ only in such
/// settings count as runs with equal settings.
bool is_for_the_report_only(std::string_view key);

/// A resolved scenario (sim::scenario::resolved_yaml()) without such keys: everything that affects
/// its runs.
std::string without_report_only(const std::string& resolved);

}  // namespace sim::scenario
