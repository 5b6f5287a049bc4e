#pragma once

#include <array>

namespace hal {

/// A vector in a plane, for example a position [m]; unit and frame are those of its user.
struct Vec2 {
  double x = 0,  ///< Component along the x axis.
      y = 0;     ///< Component along the y axis.
  /// Component by component.
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  /// Component by component.
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  /// k times each component.
  friend constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
  constexpr bool operator==(const Vec2&) const = default;  ///< Member by member.
};
/// Scalar product, in the product of both units.
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

/// A vector in space; unit and frame are those of its user, z points up.
struct Vec3 {
  double x = 0,  ///< Component along the x axis.
      y = 0,     ///< Component along the y axis.
      z = 0;     ///< Component along the z axis.
  /// Component by component.
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  /// Component by component.
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  /// k times each component.
  friend constexpr Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  constexpr bool operator==(const Vec3&) const = default;  ///< Member by member.
};
/// Scalar product, in the product of both units.
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Planar velocity of a body in its own frame.
struct Twist2 {
  double vx = 0,  ///< m/s, positive forward.
      vy = 0,     ///< m/s, positive to the left.
      omega = 0;  ///< rad/s about the vertical axis, counter-clockwise seen from above.
  constexpr bool operator==(const Twist2&) const = default;  ///< Member by member.
};

/// Position and heading in a planar frame that the user names.
struct Pose2 {
  double x = 0,   ///< m.
      y = 0,      ///< m.
      theta = 0;  ///< rad, heading counter-clockwise from the x axis, (-pi, pi].
  constexpr bool operator==(const Pose2&) const = default;  ///< Member by member.
};

}  // namespace hal
