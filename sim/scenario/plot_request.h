#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/config/mapping.h"

namespace sim::scenario {

/// What a plot shows of a quantity.
enum class PlotKind : std::uint8_t {
  kAutomatic,  ///< kPoints if any setting is varied, else kTime, else kHistogram.
  kPoints,     ///< Mean over the runs of each setting with its interval, versus a setting.
  kTable,      ///< The same as a table alone.
  kHistogram,  ///< How often which values.
  kTime,       ///< Over simulated time, the mean over runs with its interval.
};

inline constexpr std::array<hal::files::config::Option<PlotKind>, 5> kPlotKinds{
    {{"automatic", PlotKind::kAutomatic},
     {"points", PlotKind::kPoints},
     {"table", PlotKind::kTable},
     {"histogram", PlotKind::kHistogram},
     {"time", PlotKind::kTime}}};
std::string_view name_of(PlotKind kind);

/// Of the mean over runs.
enum class IntervalKind : std::uint8_t { kStudent, kBootstrap };

inline constexpr std::array<hal::files::config::Option<IntervalKind>, 2> kIntervalKinds{
    {{"student", IntervalKind::kStudent}, {"bootstrap", IntervalKind::kBootstrap}}};

/// One entry of `report:`.
struct PlotRequest {
  std::string plot{};    ///< Name of the quantity.
  std::string versus{};  ///< Key of the setting along the axis; empty: the first that is varied.
  std::string by{};      ///< Key of the setting with a curve per value; empty: all others.
  std::string agent{};   ///< Whose; empty: of the run, or the mean over the agents that have it.
  PlotKind as = PlotKind::kAutomatic;
  IntervalKind interval = IntervalKind::kStudent;
};

/// The entries as they stand in the table `settings` of a result ("report.0.plot" …).
std::vector<PlotRequest> requests_in(const std::map<std::string, std::string>& settings);

/// Names of `record: {observables: …}` in the same table, or in a resolved scenario
/// (sim::scenario::resolved_yaml()).
std::vector<std::string> observables_in(const std::map<std::string, std::string>& settings);
std::vector<std::string> observables_of(const std::string& resolved);

/// Whether a setting changes nothing about a run: `report`, `compare`. Runs that differ in such
/// only are of the same settings.
bool is_for_the_report_only(std::string_view key);

/// A resolved scenario (sim::scenario::resolved_yaml()) without such keys: what its runs depend on.
std::string without_report_only(const std::string& resolved);

}  // namespace sim::scenario
