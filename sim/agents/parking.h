#pragma once

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"

namespace sim::agents {

/// Where the body of an agent waits that takes no part: so far away that nobody meets or sees it, a
/// place for each. m, world frame
inline hal::Pose2 parking(hal::AgentId agent) {
  constexpr double kFar = 5e4;     // half as far as bodies get lost (physics::BodyLoss)
  constexpr double kApart = 20.0;  // more than any two bodies are long
  constexpr int kInRow = 100;
  const int column = agent.value % kInRow, row = agent.value / kInRow;
  return {kFar + kApart * column, kFar - kApart * row, 0};
}

}  // namespace sim::agents
