#include "controllers/bridge_robot/gaps.h"

#include <algorithm>
#include <limits>

#include "hal/types/math.h"

namespace controllers {
namespace {

double between(const Seen& a, const Seen& b) {
  const hal::Vec2 way = b.position - a.position;
  return hal::math::hypot(way.x, way.y);
}

/// The callers that are localised, grouped by island.
std::vector<std::vector<Seen>> islands_of(std::vector<Seen> callers, double reach) {
  std::vector<std::vector<Seen>> islands;
  while (!callers.empty()) {
    std::vector<Seen> island{callers.front()};
    callers.erase(callers.begin());
    for (std::size_t next = 0; next < island.size(); ++next) {
      const Seen from = island[next];
      const auto near =
          std::stable_partition(callers.begin(), callers.end(),
                                [&](const Seen& other) { return between(from, other) > reach; });
      island.insert(island.end(), near, callers.end());
      callers.erase(near, callers.end());
    }
    islands.push_back(std::move(island));
  }
  return islands;
}

/// The narrowest gap between an island and agents beyond it; without `far` if none is below `width`
/// [m].
Gap narrowest(const std::vector<Seen>& island, const std::vector<Seen>& beyond, double width) {
  Gap gap;
  gap.island = island.front().agent;
  for (const Seen& near : island) {
    for (const Seen& far : beyond) {
      if (between(near, far) >= width) continue;
      width = between(near, far);
      gap.near = near.agent;
      gap.far = far.agent;
      gap.place = 0.5 * (near.position + far.position);
    }
  }
  return gap;
}

}  // namespace

std::vector<Gap> find_gaps(const std::vector<Seen>& seen,
                           const std::map<hal::AgentId, double>& callers, double reach) {
  std::vector<Seen> calling, beyond;
  for (const Seen& one : seen) {
    if (callers.contains(one.agent)) calling.push_back(one);
  }
  std::ranges::sort(calling, {}, &Seen::agent);
  const auto is_far = [&](const Seen& one) {
    return std::ranges::all_of(calling,
                               [&](const Seen& other) { return between(other, one) > reach; });
  };
  for (const Seen& one : seen) {
    if (!callers.contains(one.agent) && is_far(one)) beyond.push_back(one);
  }
  std::vector<Gap> gaps;
  for (const std::vector<Seen>& island : islands_of(calling, reach)) {
    Gap gap = narrowest(island, beyond, 2 * reach);
    for (const Seen& one : island) gap.need += callers.at(one.agent);
    if (gap.far != hal::AgentId{}) gaps.push_back(gap);
  }
  return gaps;
}

double worth(const Gap& gap, double distance, double energy, const Weights& weights) {
  const double left = energy - weights.drive_cost * distance;
  if (left <= weights.reserve) return 0;
  return hal::math::pow(gap.need, weights.need) * hal::math::pow(left, weights.energy) /
         hal::math::pow(1 + distance, weights.distance);
}

}  // namespace controllers
