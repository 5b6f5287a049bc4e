#include "hal/robot/drivers/speed_limits.h"

#include <cmath>
#include <limits>

#include "hal/types/math.h"

namespace hal::robot::drivers {

SpeedLimits::SpeedLimits()
    : linear(std::numeric_limits<double>::infinity()),
      angular(std::numeric_limits<double>::infinity()) {}

node::devices::WheelDrive::Limited limited(const Twist2& body,
                                           const node::devices::WheelDrive& wheels,
                                           const SpeedLimits& limits) {
  double factor = 1;
  const double linear = math::hypot(body.vx, body.vy);
  if (linear > limits.linear) factor = limits.linear / linear;
  const double angular = std::abs(body.omega);
  if (angular * factor > limits.angular) factor = limits.angular / angular;
  auto result = wheels.saturate({factor * body.vx, factor * body.vy, factor * body.omega});
  result.saturated = result.saturated || factor < 1;
  return result;
}

}  // namespace hal::robot::drivers
