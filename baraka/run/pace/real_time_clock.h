#pragma once

#include <optional>
#include <span>
#include <vector>

#include "baraka/run/pace/background_work.h"
#include "baraka/run/pace/wall_pace.h"
#include "sim/agents/real_time.h"

namespace baraka::run::pace {

/// Simulated time at a factor of the wall clock, from the first call of now() on. Shows progress
/// and breaks off when interrupted, as the WallPace does that it is given, and goes by its clock.
class RealTimeClock final : public sim::agents::FollowedClock {
 public:
  /// @param factor  simulated seconds per second, above 0.
  RealTimeClock(double factor, WallPace& pace) : factor_(factor), pace_(pace) {}

  /// From now on this is attended to as well. It outlives the clock.
  void attend_to(BackgroundWork& work) { background_ = &work; }

  hal::Time now() override;

  /// Simulated time that a time of the wall's clock stands for. @pre now() has been called.
  hal::Time simulated(hal::Time wall) const;
  hal::Clock& wall() const { return pace_.clock(); }

  bool wait(hal::Time until, std::span<const int> descriptors,
            const sim::agents::Progress& progress) override;

 private:
  double factor_;
  WallPace& pace_;
  std::optional<hal::Time> start_;
  BackgroundWork* background_ = nullptr;
  std::vector<pollfd> polled_;  ///< Kept for its memory.
};

}  // namespace baraka::run::pace
