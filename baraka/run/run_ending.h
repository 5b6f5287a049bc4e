#pragma once

#include <optional>
#include <string>
#include <vector>

#include "baraka/run/network/network_of_run.h"
#include "baraka/run/results.h"
#include "baraka/run/time_advance.h"
#include "gateway/process/exit_status.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/judge.h"
#include "sim/scenario/scenario.h"

namespace baraka::run {

/// How a run ended.
struct RunEnding {
  sim::agents::Outcome outcome;
  std::vector<std::string> complaints;  ///< Problems of its controllers.
  double wall_seconds = 0;
  std::optional<network::NetworkSummary> network = {};
};

/// Ends the programs, and adds reasons to doubt the result to the complaints.
void end_network(network::NetworkOfRun& network, RunEnding& ending, const TimeAdvance& time_advance,
                 const sim::scenario::Scenario& scenario, Results& results);

/// Records and prints how the run ended. @return exit status.
gateway::process::ExitStatus conclude(Results& results, const sim::scenario::Judge& judge,
                                      const sim::agents::Simulation& simulation,
                                      RunEnding&& ending);

}  // namespace baraka::run
