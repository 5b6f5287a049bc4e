#pragma once

#include <array>
#include <span>
#include <vector>

#include "hal/node/devices/wheel.h"
#include "hal/types/geometry.h"

namespace hal::node::devices {

/// Kinematics of a body on driven wheels of any type; casters follow.
///
/// With axle heading a, roller angle g, position (px, py) and radius r, a Swedish wheel that rolls
/// without slip grips along the axis of its rollers u = (-sin(a + g), cos(a + g)) and turns at
///   (u . (vx - omega*py, vy + omega*px)) / (r cos g);
/// g is 0 for omni and fixed wheels. A fixed wheel moreover lets nothing pass along its axle:
///   (cos a, sin a) . (vx - omega*py, vy + omega*px) = 0
/// (G. Campion, G. Bastin, B. D'Andrea-Novel, "Structural Properties and Classification of
/// Kinematic and Dynamic Models of Wheeled Mobile Robots", IEEE T-RA, 1996, Swedish and fixed
/// wheels). What the fixed wheels leave are the feasible motions: all three without fixed wheels,
/// driving and turning about their axle for two on one line (a differential drive), one for two
/// parallel axles. Any thread; immutable.
class WheelDrive {
 public:
  using Row = std::array<double, 3>;

  /// @throws std::invalid_argument  no driven wheel, a radius or speed limit <= 0, fixed wheels
  /// that
  ///   hold the body where it is, or a feasible motion that no wheel drives.
  explicit WheelDrive(const std::vector<Wheel>& wheels);

  /// Driven wheels; all spans of speeds and angles hold so many, in the order of the file.
  std::size_t wheel_count() const { return body_to_wheel_.size(); }

  /// One row per driven wheel: speed [rad/s] = row . (vx [m/s], vy [m/s], omega [rad/s]).
  const std::vector<Row>& body_to_wheel() const { return body_to_wheel_; }

  /// One row per driven wheel: its share of (vx, vy, omega) per rad/s, as body_velocity() sums
  /// them.
  const std::vector<Row>& wheel_to_body() const { return wheel_to_body_; }

  /// Independent motions that the wheels allow: 3 (every motion is feasible), or 2 or 1 with fixed
  /// wheels.
  int degrees_of_freedom() const { return degrees_of_freedom_; }

  /// wheel_to_body() if some motion is not feasible, else nothing: as a session states it.
  std::vector<Row> restrictions() const {
    return degrees_of_freedom_ == 3 ? std::vector<Row>{} : wheel_to_body_;
  }

  /// Limit of the slowest wheel. rad/s
  double max_wheel_speed() const { return max_wheel_speed_; }

  /// Fastest motion along or about one axis alone: vx, vy [m/s], omega [rad/s]. Where the wheels do
  /// not allow that alone, that of the motion which project() makes of it; 0: none.
  Twist2 limits() const;

  /// Wheel speeds [rad/s] of a body velocity, in the order of the wheels; not limited.
  std::vector<double> wheel_speeds(const Twist2& twist) const;

  /// The same into `speeds`, which must hold one per wheel.
  void wheel_speeds(const Twist2& twist, std::span<double> speeds) const;

  /// Body velocity of wheel speeds [rad/s]: the feasible motion that fits them best by least
  /// squares; exact for as many wheels as degrees of freedom.
  /// @pre one speed per wheel.
  Twist2 body_velocity(std::span<const double> speeds) const;

  /// The feasible motion that the wheels make of a command: each turns as the command asks of it.
  /// A command that is feasible stays as it is; a differential drive leaves out vy.
  Twist2 project(const Twist2& twist) const;

  struct Limited {
    Twist2 twist;
    bool saturated = false;   ///< A wheel was beyond its limit.
    bool restricted = false;  ///< Part of the command was not feasible and was left out.
  };
  /// What the wheels can do of a command: project() of it, then all three components scaled by one
  /// factor so that no wheel exceeds max_wheel_speed().
  Limited saturate(const Twist2& twist) const;

 private:
  std::vector<Row> body_to_wheel_;
  std::vector<Row> wheel_to_body_;
  int degrees_of_freedom_ = 3;
  double max_wheel_speed_ = 0;
};

}  // namespace hal::node::devices
