#include "controllers/ros_base/wheel_angles.h"

#include <cmath>

#include "hal/types/math.h"

namespace controllers {
namespace {

std::array<double, 3> row_of(const hal::BodyWheel& wheel) {
  const double grip = wheel.axle_heading + wheel.roller_angle;
  const double ux = -hal::math::sin(grip), uy = hal::math::cos(grip);
  const double reach = wheel.radius * hal::math::cos(wheel.roller_angle);
  return {ux / reach, uy / reach, (uy * wheel.position.x - ux * wheel.position.y) / reach};
}

double turn(const std::array<double, 3>& row, const hal::Twist2& moved) {
  return row[0] * moved.vx + row[1] * moved.vy + row[2] * moved.omega;
}

/// Path along the arc from one pose to the next, in the body's frame [m, m, rad]. The chord is the
/// path times sin(w/2)/(w/2), turned by w/2.
hal::Twist2 arc_between(const hal::Pose2& from, const hal::Pose2& to) {
  const double omega = hal::math::wrap_angle(to.theta - from.theta);
  const double half = omega / 2;
  const double stretch = std::abs(half) < 1e-9 ? 1.0 : half / hal::math::sin(half);
  const double c = hal::math::cos(from.theta + half), s = hal::math::sin(from.theta + half);
  const double dx = to.x - from.x, dy = to.y - from.y;
  return {stretch * (c * dx + s * dy), stretch * (c * dy - s * dx), omega};
}

}  // namespace

WheelAngles::WheelAngles(const hal::RobotBody& body) {
  for (const hal::BodyWheel& wheel : body.wheels)
    if (wheel.is_driven) rows_.push_back(row_of(wheel));
  angles_.assign(rows_.size(), 0.0);
  speeds_.assign(rows_.size(), 0.0);
}

void WheelAngles::update(const hal::Odometry& odometry) {
  const hal::Twist2 moved = last_ ? arc_between(*last_, odometry.pose) : hal::Twist2{};
  last_ = odometry.pose;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    angles_[i] += turn(rows_[i], moved);
    speeds_[i] = turn(rows_[i], odometry.twist);
  }
}

}  // namespace controllers
