#pragma once

#include <optional>

#include "gateway/run/run_command.h"
#include "gateway/run/wall_pace.h"
#include "sim/agents/simulation.h"
#include "sim/record/course_log.h"
#include "sim/scenario/scenario.h"

namespace gateway {

/// How simulated time goes on in a run: in lock-step, in real time, or as it once did.
class Course {
 public:
  /// @throws UsageError  options.pace is none, or options.repeat is a run of another scenario.
  /// @throws std::runtime_error  the record cannot be read.
  Course(const RunOptions& options, const sim::scenario::Scenario& scenario);

  /// Runs the simulation, once.
  sim::agents::Outcome play(sim::agents::Simulation& simulation, WallPace& pace) const;

 private:
  std::optional<hal::Time> until_;
  std::optional<double> factor_;  ///< In real time, so fast.
  std::optional<sim::record::RecordedCourse> record_;
};

}  // namespace gateway
