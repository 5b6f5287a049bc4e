#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/time.h"

namespace sim::agents {

struct Progress;

/// The clock that simulated time follows in real time: nobody waits for controllers.
class FollowedClock {
 public:
  virtual ~FollowedClock() = default;

  /// Simulated time that the wall clock stands for. 0 at the first call; never goes back.
  virtual hal::Time now() = 0;

  /// Waits until now() reaches `until` or one of the descriptors is readable, or less.
  /// @returns false if the run is to be broken off.
  virtual bool wait(hal::Time until, std::span<const int> descriptors,
                    const Progress& progress) = 0;
};

/// A point in a run in real time at which a controller process had an influence: its answer took
/// effect, it was given the next Step, or, if neither, it died. With these a run can be repeated
/// without a clock.
struct Turn {
  hal::Time at{};        ///< All events up to and including this time have run.
  std::size_t port = 0;  ///< In order of connection.
  bool replied = false;  ///< The answer to the Step under way took effect …
  bool began = false;    ///< … and then what waited was handed over.
  bool operator==(const Turn&) const = default;
};

/// How late frames were at one edge between programs and the air, in simulated time.
struct EdgeSummary {
  std::uint64_t frames = 0;
  std::uint64_t beyond_limit = 0;  ///< Later than SimulationConfig::lateness_limit.
  hal::Duration median{}, p99{}, greatest{};
};

/// Of the agents' interfaces.
struct AirSummary {
  /// From a program into the run: an upper bound, for when the program sent the frame is not known,
  /// only when it was not there yet.
  EdgeSummary entering{};
  /// From the end of a frame's reception to when the program's side has it.
  EdgeSummary leaving{};
  std::vector<std::pair<std::string, std::uint64_t>> refused{};  ///< Frames, by reason.
  bool has_seen_tcp = false;
};

/// How well a run kept up with the clock, and its controllers with the run.
struct RealTimeSummary {
  /// Control instants that were late by more than a control period: the simulator was too slow.
  std::uint64_t overruns = 0;
  /// Control cycles that found their controller busy.
  std::uint64_t missed_cycles = 0;
  /// Wheels that were stopped because no answer had come for command_timeout.
  std::uint64_t command_timeouts = 0;
  std::uint64_t lost_events = 0;      ///< That no controller saw: overflow …
  std::vector<std::string> overflow;  ///< … by agent and cause: "r0: 12 messages".
  /// Lateness of control instants against the clock: median, 99th percentile, greatest.
  hal::Duration jitter_median{}, jitter_p99{}, jitter_max{};
  std::optional<AirSummary> air{};  ///< Of a run whose agents have networks.
};

}  // namespace sim::agents
