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

/// Seconds of the programs' time per second, of a pace as `--pace` takes it; empty, lockstep: 1.
/// @throws UsageError  it is none.
double factor_of_programs(const std::string& pace);

/// How simulated time advances in a run: in lock-step, in real time, or as in the run it repeats.
class TimeAdvance {
 public:
  /// @throws UsageError  options.pace is none, or options.repeat is a run of another scenario.
  /// @throws std::runtime_error  the record cannot be read.
  TimeAdvance(const RunOptions& options, const sim::scenario::Scenario& scenario);

  /// Runs the simulation, once. @param network  of it; null: none, or a repetition.
  sim::agents::Outcome play(sim::agents::Simulation& simulation, pace::WallPace& pace,
                            network::NetworkOfRun* network) const;

  /// As `--pace` says or, without it, as the scenario needs it: "lockstep", "realtime:0.1".
  const std::string& pace() const { return pace_; }
  /// Simulated seconds per second; none: not in real time.
  std::optional<double> factor() const { return factor_; }
  bool is_repeated() const { return record_.has_value(); }
  /// Of a repetition: what controllers inside their agents' networks answered; else null.
  const std::vector<sim::OutsideArrival>* replies() const {
    return is_repeated() ? &replies_ : nullptr;
  }
  /// Of a repetition: what is not as it was, "radio.data_rate: 11 Mb/s instead of 2 Mb/s".
  const std::vector<std::string>& open_loop() const { return open_loop_; }

 private:
  std::string pace_;
  std::vector<std::string> open_loop_;
  std::optional<hal::Time> until_;
  std::optional<double> factor_;                      ///< In real time, so fast.
  std::optional<results::record::ReplayLog> record_;  ///< Without …
  std::vector<sim::OutsideArrival> replies_;          ///< … these.
};

}  // namespace baraka::run
