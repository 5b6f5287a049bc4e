#pragma once

#include <optional>
#include <span>
#include <vector>

#include "baraka/run/pace/background_work.h"
#include "baraka/run/pace/wall_pace.h"
#include "sim/agents/real_time.h"

namespace baraka::run::pace {

/// Simulated time that follows the wall clock at a factor, from the first call of now() on. Uses a
/// WallPace for the clock, for showing progress and for interrupts.
class RealTimeClock final : public sim::agents::FollowedClock {
 public:
  /// @param factor  simulated seconds per second, above 0.
  RealTimeClock(double factor, WallPace& pace) : factor_(factor), pace_(pace) {}

  /// Adds background work. @param work  must outlive the clock.
  void attend_to(BackgroundWork& work) { background_ = &work; }

  hal::Time now() override;

  /// Converts wall time to simulated time. @pre now() has been called.
  hal::Time simulated(hal::Time wall) const;
  hal::Clock& wall() const { return pace_.clock(); }

  bool wait(hal::Time until, std::span<const int> descriptors,
            const sim::agents::Progress& progress) override;

 private:
  double factor_;
  WallPace& pace_;
  std::optional<hal::Time> start_;
  BackgroundWork* background_ = nullptr;
  std::vector<pollfd> polled_;  ///< A member to avoid allocating it for each wait.
};

}  // namespace baraka::run::pace
