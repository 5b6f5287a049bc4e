#pragma once

#include <array>
#include <span>
#include <vector>

#include "hal/devices/robot_description.h"
#include "hal/types/geometry.h"

namespace hal::devices {

/// Kinematics of a body on three or more omnidirectional wheels.
///
/// With axle heading a, position (px, py) and radius r, a wheel that rolls without slip along its
/// rolling direction d = (-sin a, cos a) turns at
///   (d . (vx - omega*py, vy + omega*px)) / r
/// (G. Campion, G. Bastin, B. D'Andrea-Novel, "Structural Properties and Classification of
/// Kinematic and Dynamic Models of Wheeled Mobile Robots", IEEE T-RA, 1996, Swedish wheel with
/// rollers at 90 degrees). Any thread; immutable.
class WheelDrive {
 public:
  /// @throws std::invalid_argument  fewer than three wheels, a radius or speed limit <= 0, or axles
  ///   that leave a direction of the body undriven.
  explicit WheelDrive(const std::vector<Wheel>& wheels);

  std::size_t wheel_count() const { return body_to_wheel_.size(); }

  /// One row per wheel: wheel speed [rad/s] = row . (vx [m/s], vy [m/s], omega [rad/s]).
  const std::vector<std::array<double, 3>>& body_to_wheel() const { return body_to_wheel_; }

  /// Limit of the slowest wheel. rad/s
  double max_wheel_speed() const { return max_wheel_speed_; }

  /// Fastest motion along or about one axis alone: vx, vy [m/s], omega [rad/s].
  Twist2 limits() const;

  /// Wheel speeds [rad/s] of a body velocity, in the order of the wheels; not limited.
  std::vector<double> wheel_speeds(const Twist2& twist) const;

  /// The same into `speeds`, which must hold one per wheel.
  void wheel_speeds(const Twist2& twist, std::span<double> speeds) const;

  /// Body velocity of wheel speeds [rad/s]: exact for three wheels, least squares for more.
  /// @pre one speed per wheel.
  Twist2 body_velocity(std::span<const double> speeds) const;

  struct Limited {
    Twist2 twist;
    bool saturated = false;  ///< A wheel was beyond its limit.
  };
  /// Scales all three components by one factor so that no wheel exceeds max_wheel_speed().
  Limited saturate(const Twist2& twist) const;

 private:
  std::vector<std::array<double, 3>> body_to_wheel_;
  std::vector<std::array<double, 3>> wheel_to_body_;  ///< Per wheel its share of (vx, vy, omega).
  double max_wheel_speed_ = 0;
};

}  // namespace hal::devices
