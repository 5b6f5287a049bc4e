#pragma once

#include <array>
#include <span>
#include <vector>

#include "hal/node/devices/wheel.h"
#include "hal/types/geometry.h"

namespace hal::node::devices {

/// Kinematics of a body on driven wheels of any type; casters are ignored.
///
/// With axle heading a, roller angle g, position (px, py) and radius r, a Swedish wheel that rolls
/// without slip grips along the axis of its rollers u = (-sin(a + g), cos(a + g)) and turns at
///   (u . (vx - omega*py, vy + omega*px)) / (r cos g);
/// g is 0 for omni and fixed wheels. A fixed wheel in addition permits no motion along its axle:
///   (cos a, sin a) . (vx - omega*py, vy + omega*px) = 0
/// (G. Campion, G. Bastin, B. D'Andrea-Novel, "Structural Properties and Classification of
/// Kinematic and Dynamic Models of Wheeled Mobile Robots", IEEE T-RA, 1996, Swedish and fixed
/// wheels). The motions that the fixed wheels permit are feasible: all three without fixed wheels;
/// driving and turning about the centre of the axle for two wheels on one line (a differential
/// drive); one for two parallel axles. Any thread; immutable.
class WheelDrive {
 public:
  using Row = std::array<double, 3>;

  /// @throws std::invalid_argument  no driven wheel, a radius or speed limit <= 0, fixed wheels
  ///   that permit no motion, or a feasible motion that no wheel drives.
  explicit WheelDrive(const std::vector<Wheel>& wheels);

  /// Number of driven wheels; all spans of speeds and angles have this length, in the file's order.
  std::size_t wheel_count() const { return body_to_wheel_.size(); }

  /// One row per driven wheel: speed [rad/s] = row . (vx [m/s], vy [m/s], omega [rad/s]).
  const std::vector<Row>& body_to_wheel() const { return body_to_wheel_; }

  /// One row per driven wheel: its contribution to (vx, vy, omega) per rad/s, as summed by
  /// body_velocity().
  const std::vector<Row>& wheel_to_body() const { return wheel_to_body_; }

  /// Number of independent motions that the wheels permit: 3 (every motion is feasible), or 2 or 1
  /// with fixed wheels.
  int degrees_of_freedom() const { return degrees_of_freedom_; }

  /// wheel_to_body() if some motion is not feasible, otherwise empty, as DriveLimits states it.
  std::vector<Row> restrictions() const {
    return degrees_of_freedom_ == 3 ? std::vector<Row>{} : wheel_to_body_;
  }

  /// Limit of the slowest wheel, rad/s.
  double max_wheel_speed() const { return max_wheel_speed_; }

  /// Largest component of velocity along or about each axis: vx, vy [m/s], omega [rad/s], reached
  /// by the fastest motions that project() makes of commands along one axis; 0: none.
  Twist2 limits() const;

  /// Wheel speeds [rad/s] of a body velocity, in the order of the wheels; not limited.
  std::vector<double> wheel_speeds(const Twist2& twist) const;

  /// The same into `speeds`, which must hold one per wheel.
  void wheel_speeds(const Twist2& twist, std::span<double> speeds) const;

  /// Body velocity for wheel speeds [rad/s]: the feasible motion that fits them best in the
  /// least-squares sense; exact if there are as many wheels as degrees of freedom.
  /// @pre one speed per wheel.
  Twist2 body_velocity(std::span<const double> speeds) const;

  /// The feasible motion that results if each wheel turns as the command requires. A feasible
  /// command is unchanged; a differential drive omits vy.
  Twist2 project(const Twist2& twist) const;

  struct Limited {
    Twist2 twist;
    bool saturated = false;   ///< A wheel exceeded its limit.
    bool restricted = false;  ///< Part of the command was not feasible and was left out.
  };
  /// The motion that the wheels can perform for a command: project() of it, with all three
  /// components scaled by one factor so that no wheel exceeds max_wheel_speed().
  Limited saturate(const Twist2& twist) const;

 private:
  std::vector<Row> body_to_wheel_;
  std::vector<Row> wheel_to_body_;
  int degrees_of_freedom_ = 3;
  double max_wheel_speed_ = 0;
};

}  // namespace hal::node::devices
