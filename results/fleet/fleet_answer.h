#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/fleet/fleet_file.h"
#include "results/fleet/fleet_points.h"
#include "results/fleet/fleet_run.h"
#include "results/statistics/interval.h"

namespace results::fleet {

/// A quantity of a case, of the runs that have it: the mean over them, or a quantile of all of
/// their samples together.
struct Estimate {
  double value = 0;
  std::optional<statistics::Interval> interval{};  ///< At statistics::kLevel; none: one run.
  std::size_t runs = 0;
};

/// Samples of some topics over the runs of a case. nullopt: no run has the quantity.
struct SampleAnswer {
  std::optional<Estimate> delivered, first_try, age, discovered;  ///< Means over the runs.
  std::optional<Estimate> p50, p95, p99;    ///< Latency of all samples that arrived. [s]
  std::uint64_t pairs = 0, silent = 0;      ///< Sums over the runs.
  std::uint64_t samples = 0, repaired = 0;  ///< Likewise.
  std::uint64_t under_way = 0;              ///< Likewise.
  std::size_t unsent = 0;  ///< Runs in which nothing was sent in the window, and all had samples.
  std::map<std::string, std::uint64_t> lost{};  ///< Likewise: see SampleMeasure.
  std::size_t runs = 0;
};

/// Why a case does not hold.
enum class Cause : std::uint8_t {
  kAirFull,    ///< A radio has frames to send nearly all the time, and the medium is busy.
  kQueue,      ///< Frames are dropped or wait in a queue, though there is air.
  kDiscovery,  ///< Writers and readers have not found each other, or too late.
  kRange,      ///< Frames are lost to weak signals, or their retries are.
  kCollision,  ///< Frames are lost to other frames.
  kHandover,   ///< Stations change their access points.
  kNoAccessPoint,
  kRepairs,  ///< DDS repairs what was lost, which takes too long.
  kOther,
};
/// "the air is full", …
std::string_view name(Cause cause);

/// The limit that a case misses.
struct Miss {
  std::size_t need = 0;  ///< Index.
  std::string what;      ///< "delivered 93.2 % of 99 %".
  Cause cause = Cause::kOther;
  std::string evidence;  ///< "r3's radio is busy 97 % of the time; 83 % of the lost samples: …".
};

/// One case: some robots with one radio, site and profile.
struct CaseAnswer {
  Case which;
  std::size_t runs = 0, failed = 0;
  std::vector<SampleAnswer> needs;
  std::map<std::string, SampleAnswer> topics;  ///< By topic group.
  std::map<std::string, Estimate> air;         ///< Shares of the time, by use.
  std::optional<Estimate> busy, backlogged;    ///< See FleetRun.
  std::string busiest, most_backlogged;
  double handovers = 0, unassociated = 0;  ///< Means over the runs.
  std::optional<double> ended_s{};         ///< When the shortest run ended.
  double wall_s = 0;                       ///< Mean wall time of a run.
  std::vector<Miss> misses;
  bool holds() const { return runs > 0 && misses.empty(); }
};

/// All numbers of robots with one radio, site and profile.
struct FleetLine {
  std::size_t radio = 0, site = 0, profile = 0;
  std::vector<CaseAnswer> cases;  ///< By ascending number of robots.
  /// The largest number up to which every need holds at every number that was tried; nullopt: not
  /// even the least.
  std::optional<int> largest() const;
  const CaseAnswer* first_miss() const;  ///< Null: every need holds at all numbers.
  std::size_t runs() const;              ///< That ended well.
  std::size_t failed() const;
};

/// @param runs  of one case. @param failed  number of its runs that failed.
CaseAnswer answer_of(const FleetFile& fleet, const Case& which, const std::vector<FleetRun>& runs,
                     std::size_t failed);

/// The lines of the cases, which have the order of plan_of().
std::vector<FleetLine> lines_of(std::vector<CaseAnswer> cases);

/// The lines with one radio and site that have runs, the best first: more robots, then less use of
/// the air at that number. Where none holds with the least number: fewer limits missed there, then
/// more samples delivered.
std::vector<const FleetLine*> ranked(const std::vector<FleetLine>& lines, std::size_t radio,
                                     std::size_t site);

/// Use of the air in all, as a share of the time.
double air_of(const CaseAnswer& one);

}  // namespace results::fleet
