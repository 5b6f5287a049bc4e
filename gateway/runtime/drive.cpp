#include "gateway/runtime/drive.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gateway::runtime {

namespace {

double speed_of(const std::array<double, 3>& row, const hal::Twist2& twist) {
  return row[0] * twist.vx + row[1] * twist.vy + row[2] * twist.omega;
}

/// The feasible motion that the wheels produce for a command: see hal/node/devices/wheel_drive.h.
hal::Twist2 feasible(const hal::node::exchange::DriveLimits& limits, const hal::Twist2& twist) {
  if (limits.wheel_to_body.empty()) return twist;
  hal::Twist2 motion;
  const std::size_t wheels = std::min(limits.body_to_wheel.size(), limits.wheel_to_body.size());
  for (std::size_t i = 0; i < wheels; ++i) {
    const double speed = speed_of(limits.body_to_wheel[i], twist);
    motion.vx += limits.wheel_to_body[i][0] * speed;
    motion.vy += limits.wheel_to_body[i][1] * speed;
    motion.omega += limits.wheel_to_body[i][2] * speed;
  }
  return motion;
}

/// Whether two velocities (m/s, rad/s) differ by more than rounding.
bool differ(const hal::Twist2& a, const hal::Twist2& b) {
  constexpr double kRounding = 1e-9;
  return std::abs(a.vx - b.vx) > kRounding || std::abs(a.vy - b.vy) > kRounding ||
         std::abs(a.omega - b.omega) > kRounding;
}

}  // namespace

hal::Drive saturate(const hal::node::exchange::DriveLimits& limits, const hal::Twist2& wanted) {
  const hal::Twist2 twist = feasible(limits, wanted);
  const bool restricted = differ(twist, wanted);
  double fastest = 0;
  for (const auto& row : limits.body_to_wheel)
    fastest = std::max(fastest, std::abs(speed_of(row, twist)));
  if (fastest <= limits.wheel_speed)
    return {.applied = twist, .saturated = false, .restricted = restricted};
  const double scale = limits.wheel_speed / fastest;
  return {.applied = {scale * twist.vx, scale * twist.vy, scale * twist.omega},
          .saturated = true,
          .restricted = restricted};
}

}  // namespace gateway::runtime
