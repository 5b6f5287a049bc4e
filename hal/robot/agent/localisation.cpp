#include "hal/robot/agent/localisation.h"

#include "hal/types/math.h"

namespace hal::robot::agent {

std::vector<double> relative_positions(const Pose2& self, AgentId self_id,
                                       const std::vector<Landmark>& map, double range) {
  const double c = math::cos(self.theta);
  const double s = math::sin(self.theta);
  std::vector<double> triples;
  for (const Landmark& landmark : map) {
    const Vec2 to = landmark.position - Vec2{self.x, self.y};
    if (landmark.agent == self_id || math::hypot(to.x, to.y) > range) continue;
    triples.insert(triples.end(), {static_cast<double>(landmark.agent.value), c * to.x + s * to.y,
                                   c * to.y - s * to.x});
  }
  return triples;
}

}  // namespace hal::robot::agent
