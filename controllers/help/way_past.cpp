#include "controllers/help/way_past.h"

#include <cmath>
#include <optional>

namespace controllers {

using hal::Vec2;

Vec2 way_past(Vec2 way, std::span<const double> localised, double clearance) {
  const Vec2 left{-way.y, way.x};
  std::optional<Vec2> nearest;
  for (std::size_t i = 0; i + 2 < localised.size(); i += 3) {
    const Vec2 agent{localised[i + 1], localised[i + 2]};
    const double ahead = hal::dot(way, agent);
    if (ahead <= 0 || ahead > kLookAhead || std::abs(hal::dot(left, agent)) >= clearance) continue;
    if (!nearest || ahead < hal::dot(way, *nearest)) nearest = agent;
  }
  if (!nearest) return way;
  // Passes on the side with the shorter detour; on the left if the agent is exactly ahead.
  const double side = hal::dot(left, *nearest) > 0 ? -1 : 1;
  const Vec2 beside = *nearest + side * clearance * left;
  return 1 / std::sqrt(hal::dot(beside, beside)) * beside;
}

}  // namespace controllers
