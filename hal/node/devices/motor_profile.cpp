#include "hal/node/devices/motor_profile.h"

#include <algorithm>
#include <cmath>

#include "hal/types/check.h"

namespace hal::node::devices {
namespace {

/// One step of `now` towards `target`: at the rate `down` while the magnitude decreases, then `up`.
Vec2 approach(Vec2 now, Vec2 target, double up, double down, double seconds) {
  const Vec2 change = target - now;
  const double distance = std::sqrt(dot(change, change));
  if (distance == 0) return target;
  const Vec2 direction = (1 / distance) * change;
  const double braking = std::clamp(-dot(now, direction), 0.0, distance);
  const double braking_time = braking / down;
  const double travel =
      seconds <= braking_time ? down * seconds : braking + up * (seconds - braking_time);
  if (travel >= distance) return target;
  return now + travel * direction;
}

}  // namespace

Twist2 MotorProfile::advance(const Twist2& target, Duration step) {
  BARAKA_CHECK(step > Duration::zero());
  if (velocity_ == target) return velocity_ = target;
  const double seconds = to_seconds(step);
  const Vec2 linear = approach({velocity_.vx, velocity_.vy}, {target.vx, target.vy},
                               limits_.linear_up, limits_.linear_down, seconds);
  const Vec2 angular = approach({velocity_.omega, 0}, {target.omega, 0}, limits_.angular_up,
                                limits_.angular_down, seconds);
  velocity_ = {linear.x, linear.y, angular.x};
  return velocity_;
}

}  // namespace hal::node::devices
