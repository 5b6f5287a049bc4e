#include "sim/sensing/relative_localisation.h"

#include "hal/types/math.h"

namespace sim::sensing {

std::vector<AgentPosition> localise(const hal::Pose2& self, hal::AgentId own,
                                    std::span<const AgentPosition> agents, double range) {
  const double c = hal::math::cos(self.theta);
  const double s = hal::math::sin(self.theta);
  std::vector<AgentPosition> found;
  for (const AgentPosition& other : agents) {
    const hal::Vec2 offset = other.position - hal::Vec2{self.x, self.y};
    if (other.agent == own || hal::dot(offset, offset) > range * range) continue;
    found.push_back({other.agent, {c * offset.x + s * offset.y, c * offset.y - s * offset.x}});
  }
  return found;
}

}  // namespace sim::sensing
