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

/// Limits the speed of a simulation relative to the wall clock, shows progress on standard error,
/// and stops the run when it is interrupted.
class WallPace final : public sim::agents::Pace {
 public:
  struct Settings {
    /// Simulated seconds per wall second.
    double max_speed = std::numeric_limits<double>::infinity();
    /// True: progress is rewritten in place twice a second; false: a line every 10 s.
    bool terminal = false;
    std::size_t processes = 0;  ///< Number of controller processes, shown with the progress.
    /// Latest end of the run, to show progress in percent; none: not known.
    std::optional<hal::Time> end = {};
    bool may_end_earlier = false;  ///< A condition may end the run before `end`.
    std::function<void()>
        once_a_second;  ///< Called every second of wall time, for example to save.
    /// Called before each instant. Returns the time to wait before it is called again; none: go on.
    /// May be empty.
    std::function<std::optional<hal::Duration>(hal::Time next)> hold = {};
  };

  /// @param clock  must outlive this object.
  explicit WallPace(Settings settings, hal::Clock& clock = gateway::process::wall_clock())
      : settings_(std::move(settings)), clock_(clock) {}

  hal::Clock& clock() const { return clock_; }

  Verdict may_go_on(hal::Time next, const sim::agents::Progress& progress) override;

  /// Whether the run was interrupted: of a run that waits for programs between two instants.
  bool is_broken_off();

  /// Ends the progress line.
  void end();

  /// Wall time from the first call to the last, s.
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
