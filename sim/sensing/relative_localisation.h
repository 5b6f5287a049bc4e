#pragma once

#include <span>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"

namespace sim::sensing {

/// Position of an agent.
struct AgentPosition {
  hal::AgentId agent;
  hal::Vec2 position;  ///< m
};

/// Positions of the other agents within range, in the frame of `self`; order as in `agents`.
/// No occlusion, no noise. Any thread.
/// @param agents  world frame. @param own  excluded from the result. @param range  m, inclusive.
std::vector<AgentPosition> localise(const hal::Pose2& self, hal::AgentId own,
                                    std::span<const AgentPosition> agents, double range);

}  // namespace sim::sensing
