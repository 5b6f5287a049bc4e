#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "gateway/process/waiting.h"
#include "hal/types/clock.h"
#include "sim/agents/simulation.h"

namespace baraka::run::pace {

/// Runs a simulation no faster than a factor times the wall clock, shows progress on standard
/// error, and breaks off when interrupted.
class WallPace final : public sim::agents::Pace {
 public:
  struct Settings {
    double max_speed = std::numeric_limits<double>::infinity();  ///< Simulated per wall second.
    bool terminal = false;      ///< Progress in place, twice a second; else a line every 10 s.
    std::size_t processes = 0;  ///< Of controllers, to show.
    /// When the run ends at the latest, to show what share of it is over; none: it is not known.
    std::optional<hal::Time> end = {};
    bool may_end_earlier = false;         ///< By a condition.
    std::function<void()> once_a_second;  ///< Of wall time, e.g. to save what there is.
    /// Asked before each instant how long to wait before it is asked again; none: go on. May be
    /// empty.
    std::function<std::optional<hal::Duration>(hal::Time next)> hold = {};
  };

  /// @param clock  outlives the pace.
  explicit WallPace(Settings settings, hal::Clock& clock = gateway::process::wall_clock())
      : settings_(std::move(settings)), clock_(clock) {}

  hal::Clock& clock() const { return clock_; }

  Verdict may_go_on(hal::Time next, const sim::agents::Progress& progress) override;

  /// Leaves the line of the progress.
  void end();

  /// Wall seconds from the first call to the last.
  double wall_seconds() const { return hal::to_seconds(last_ - start_); }

 private:
  bool throttle(hal::Time next);
  bool hold(hal::Time next);
  void show(const sim::agents::Progress& progress);
  /// "10.0 of 20.0 s simulated (50 %), 5 s left".
  std::string simulated(hal::Time now) const;

  Settings settings_;
  hal::Clock& clock_;
  hal::Time start_{}, last_{}, shown_{}, saved_{};
  hal::Time shown_time_{};
  bool started_ = false, line_open_ = false;
};

}  // namespace baraka::run::pace
