#pragma once

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"

namespace sim::agents {

/// Place of the body of an agent that is not present: one for each agent, so far away that no other
/// agent meets or senses it. [m], world frame.
inline hal::Pose2 parking(hal::AgentId agent) {
  constexpr double kFar = 5e4;     // half the distance at which bodies are lost (physics::BodyLoss)
  constexpr double kApart = 20.0;  // longer than any body
  constexpr int kInRow = 100;
  const int column = agent.value % kInRow, row = agent.value / kInRow;
  return {kFar + kApart * column, kFar - kApart * row, 0};
}

}  // namespace sim::agents
