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

/// The clock that simulated time follows in a real-time run, which never waits for controllers.
class FollowedClock {
 public:
  virtual ~FollowedClock() = default;

  /// Simulated time that corresponds to the wall clock. 0 at the first call; never decreases.
  virtual hal::Time now() = 0;

  /// Waits until now() reaches `until` or one of the descriptors is readable; may return earlier.
  /// @return false if the run is to be interrupted.
  virtual bool wait(hal::Time until, std::span<const int> descriptors,
                    const Progress& progress) = 0;
};

/// A point in a real-time run at which a controller process influenced the run: its reply took
/// effect, it was given the next Step, or, if neither, it died. From these a run can be repeated
/// without a clock.
struct Turn {
  hal::Time at{};        ///< All events up to and including this time have run.
  std::size_t port = 0;  ///< In order of connection.
  bool replied = false;  ///< The reply to the pending Step took effect.
  bool began = false;    ///< After that, the waiting events were passed on as the next Step.
  bool operator==(const Turn&) const = default;
};

/// Statistics of the lateness of frames at one edge between programs and the air, in simulated
/// time.
struct EdgeSummary {
  std::uint64_t frames = 0;
  std::uint64_t beyond_limit = 0;  ///< Later than SimulationConfig::lateness_limit.
  hal::Duration median{}, p99{}, greatest{};
};

/// Statistics of the agents' interfaces.
struct AirSummary {
  /// From a program into the run. An upper bound, because the time of sending is not known, only a
  /// time at which the frame had not been sent.
  EdgeSummary entering{};
  /// From the end of a frame's reception until it is passed on towards the program.
  EdgeSummary leaving{};
  std::vector<std::pair<std::string, std::uint64_t>> refused{};  ///< Number of frames by reason.
  bool has_seen_tcp = false;
};

/// How well a run kept up with the clock, and controllers with the run.
struct RealTimeSummary {
  /// Control instants later than a control period: the simulator was too slow.
  std::uint64_t overruns = 0;
  /// Control cycles at which the controller was still busy.
  std::uint64_t missed_cycles = 0;
  /// Times that wheels were stopped because no reply had come for command_timeout.
  std::uint64_t command_timeouts = 0;
  std::uint64_t lost_events = 0;      ///< Events dropped for overflow, which no controller saw.
  std::vector<std::string> overflow;  ///< The same by agent and cause: "r0: 12 messages".
  /// Lateness of control instants against the clock: median, 99th percentile, maximum.
  hal::Duration jitter_median{}, jitter_p99{}, jitter_max{};
  std::optional<AirSummary> air{};  ///< If agents have networks.
};

}  // namespace sim::agents
