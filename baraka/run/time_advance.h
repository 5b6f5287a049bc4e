#pragma once

#include <optional>
#include <string>
#include <vector>

#include "baraka/run/network/network_of_run.h"
#include "baraka/run/pace/wall_pace.h"
#include "baraka/run/run_command.h"
#include "results/record/replay_log.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"

namespace baraka::run {

/// How simulated time advances in a run: in lock-step, in real time, or as in a recorded run.
class TimeAdvance {
 public:
  /// @throws UsageError  options.pace is not a valid pace, or options.repeat is a run of another
  ///   scenario.
  /// @throws std::runtime_error  the record cannot be read.
  TimeAdvance(const RunOptions& options, const sim::scenario::Scenario& scenario);

  /// Runs the simulation. To be called once.
  /// @param network  of the run; null: it has none, or is a repetition.
  sim::agents::Outcome play(sim::agents::Simulation& simulation, pace::WallPace& pace,
                            network::NetworkOfRun* network) const;

  /// The value of `--pace` or, without it, what the scenario requires: "lockstep", "realtime:0.1".
  const std::string& pace() const { return pace_; }
  /// Simulated seconds per second; none: not in real time.
  std::optional<double> factor() const { return factor_; }
  bool is_repeated() const { return record_.has_value(); }
  /// In a repetition: the recorded answers of controllers inside networks; otherwise null.
  const std::vector<sim::OutsideArrival>* replies() const {
    return is_repeated() ? &replies_ : nullptr;
  }
  /// In a repetition: whether the recorded run was in lock-step.
  bool repeats_lockstep() const { return is_repeated() && !record_->in_real_time; }
  /// In a repetition: settings that differ from the recorded run, "radio.data_rate: 11 Mb/s instead
  /// of 2 Mb/s".
  const std::vector<std::string>& open_loop() const { return open_loop_; }

 private:
  std::string pace_;
  std::vector<std::string> open_loop_;
  std::optional<hal::Time> until_;
  std::optional<double> factor_;                      ///< Real time only: simulated s per s.
  std::optional<results::record::ReplayLog> record_;  ///< In real time without replies_.
  std::vector<sim::OutsideArrival> replies_;          ///< See replies().
};

}  // namespace baraka::run
