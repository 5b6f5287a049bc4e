#pragma once

#include <array>

namespace hal {

struct Vec2 {
  double x = 0, y = 0;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
  constexpr bool operator==(const Vec2&) const = default;
};
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  constexpr bool operator==(const Vec3&) const = default;
};
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Planar velocity of a body in its own frame: x forward, y left [m/s], omega about z, counter-
/// clockwise seen from above [rad/s].
struct Twist2 {
  double vx = 0, vy = 0, omega = 0;
  constexpr bool operator==(const Twist2&) const = default;
};

/// Position [m] and heading [rad, counter-clockwise from x, (-pi, pi]] in a named planar frame.
struct Pose2 {
  double x = 0, y = 0, theta = 0;
  constexpr bool operator==(const Pose2&) const = default;
};

}  // namespace hal
