#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace gateway::app {

/// What the scenario says about its controllers, judged without running them.
struct ControllerJudgement {
  std::vector<std::string> mistakes;     ///< "file:line:column: key: what is wrong".
  std::vector<std::string> not_checked;  ///< Programs whose plug-in is not there.
};

/// Loads the plug-in of each program, and checks the agents' parameters and kinds against it. A
/// program that is neither found as a plug-in nor as a program is a mistake.
ControllerJudgement judge_controllers(const sim::scenario::Scenario& scenario);

}  // namespace gateway::app
