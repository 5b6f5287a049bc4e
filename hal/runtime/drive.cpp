#include "hal/runtime/drive.h"

#include <fmt/core.h>

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

std::string mistake_in(const Twist2& twist) {
  const std::pair<const char*, double> fields[] = {
      {"vx", twist.vx}, {"vy", twist.vy}, {"omega", twist.omega}};
  for (const auto& [field, value] : fields) {
    if (!std::isfinite(value)) return fmt::format("{} is {}, it must be finite", field, value);
  }
  return {};
}

std::string mistake_in(const exchange::DriveLimits& limits, std::span<const double> wheel_speeds) {
  const std::size_t wheels = limits.body_to_wheel.size();
  if (wheel_speeds.size() != wheels) {
    return fmt::format("speeds has {} values, the robot has {} wheels", wheel_speeds.size(),
                       wheels);
  }
  for (std::size_t i = 0; i < wheels; ++i) {
    // Written so that NaN, which compares false with everything, is caught too.
    if (std::abs(wheel_speeds[i]) <= limits.wheel_speed) continue;
    return fmt::format("speeds[{}] is {} rad/s, the limit is {} rad/s", i, wheel_speeds[i],
                       limits.wheel_speed);
  }
  return {};
}

}  // namespace hal::runtime
