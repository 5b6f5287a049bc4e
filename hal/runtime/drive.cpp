#include "hal/runtime/drive.h"

#include <algorithm>
#include <cmath>

namespace hal::runtime {

Drive saturate(const exchange::DriveLimits& limits, const Twist2& twist) {
  double fastest = 0;
  for (const auto& [per_vx, per_vy, per_omega] : limits.body_to_wheel) {
    const double speed = per_vx * twist.vx + per_vy * twist.vy + per_omega * twist.omega;
    fastest = std::max(fastest, std::abs(speed));
  }
  if (fastest <= limits.wheel_speed) return {.applied = twist, .saturated = false};
  const double scale = limits.wheel_speed / fastest;
  return {.applied = {scale * twist.vx, scale * twist.vy, scale * twist.omega}, .saturated = true};
}

}  // namespace hal::runtime
