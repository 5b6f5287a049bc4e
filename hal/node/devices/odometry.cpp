#include "hal/node/devices/odometry.h"

#include <cmath>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::node::devices {

WheelOdometry::WheelOdometry(const WheelDrive& drive, int encoder_steps)
    : drive_(drive),
      angle_per_step_(encoder_steps > 0 ? 2 * math::kPi / encoder_steps : 0),
      previous_(drive.wheel_count(), 0.0) {}

void WheelOdometry::restart(std::span<const double> wheel_angles) {
  BARAKA_CHECK(wheel_angles.size() == previous_.size());
  for (std::size_t i = 0; i < previous_.size(); ++i) previous_[i] = encoded(wheel_angles[i]);
  pose_ = {};
  twist_ = {};
}

void WheelOdometry::update(std::span<const double> wheel_angles, Duration elapsed) {
  BARAKA_CHECK(wheel_angles.size() == previous_.size() && elapsed > Duration::zero());
  std::vector<double> turned(previous_.size());
  for (std::size_t i = 0; i < previous_.size(); ++i) {
    const double angle = encoded(wheel_angles[i]);
    turned[i] = angle - previous_[i];
    previous_[i] = angle;
  }
  const Twist2 moved = drive_.body_velocity(turned);
  const double seconds = to_seconds(elapsed);
  twist_ = {moved.vx / seconds, moved.vy / seconds, moved.omega / seconds};

  // On an arc of angle w the chord is the path length times sin(w/2)/(w/2), turned by w/2.
  const double half = 0.5 * moved.omega;
  const double shrink = std::abs(half) < 1e-9 ? 1.0 : math::sin(half) / half;
  const double c = shrink * math::cos(pose_.theta + half);
  const double s = shrink * math::sin(pose_.theta + half);
  pose_.x += c * moved.vx - s * moved.vy;
  pose_.y += s * moved.vx + c * moved.vy;
  pose_.theta = math::wrap_angle(pose_.theta + moved.omega);
}

double WheelOdometry::encoded(double angle) const {
  if (angle_per_step_ == 0) return angle;
  return std::floor(angle / angle_per_step_) * angle_per_step_;
}

}  // namespace hal::node::devices
