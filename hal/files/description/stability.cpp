#include "hal/files/description/stability.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "hal/node/devices/wheel_drive.h"
#include "hal/types/math.h"

namespace hal::files::description {
namespace {

using node::devices::RobotDescription;
using node::devices::Wheel;
using node::devices::WheelType;

/// A solid part of the robot.
struct SolidPart {
  double mass;
  Vec3 centre;  ///< m, body frame
  /// m^2, mean products of the components of the distance of its mass from its centre.
  Eigen::Matrix3d spread;
};

Eigen::Vector3d in_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

/// @param squares  mean squared distances along its own axes, m^2. @param yaw  rad
Eigen::Matrix3d spread(const Vec3& squares, double yaw) {
  const double cos = math::cos(yaw), sin = math::sin(yaw);
  Eigen::Matrix3d turn;
  turn << cos, -sin, 0, sin, cos, 0, 0, 0, 1;
  return turn * in_eigen(squares).asDiagonal() * turn.transpose();
}

/// The body as one part, from its tensor I: mean products are (tr(I) / 2 - I) / mass.
SolidPart part_of(const node::devices::BodyInertia& c) {
  Eigen::Matrix3d tensor;
  tensor << c.moments.x, c.products.x, c.products.y, c.products.x, c.moments.y, c.products.z,
      c.products.y, c.products.z, c.moments.z;
  return {c.mass, c.centre, (tensor.trace() / 2 * Eigen::Matrix3d::Identity() - tensor) / c.mass};
}

void add_shapes(std::vector<SolidPart>& parts, const RobotDescription& robot) {
  for (const auto& c : robot.cylinders) {
    const double length = c.z_top - c.z_bottom;
    const double round = c.radius * c.radius / 4;
    parts.push_back({c.mass,
                     {c.centre.x, c.centre.y, (c.z_bottom + c.z_top) / 2},
                     spread({round, round, length * length / 12}, 0)});
  }
  for (const auto& b : robot.boxes) {
    const Vec3 squares{b.size.x * b.size.x, b.size.y * b.size.y, b.size.z * b.size.z};
    parts.push_back({b.mass, b.centre, spread((1.0 / 12) * squares, b.yaw)});
  }
}

std::vector<SolidPart> parts_of(const RobotDescription& robot) {
  std::vector<SolidPart> parts;
  if (robot.inertia) {
    parts.push_back(part_of(*robot.inertia));
  } else {
    add_shapes(parts, robot);
  }
  for (const Wheel& w : robot.wheels) {
    if (robot.inertia && !w.is_driven()) continue;  // part of the body
    const double round = w.radius * w.radius / 5;   // a sphere, as in the simulator
    parts.push_back(
        {w.mass, {w.position.x, w.position.y, w.radius}, spread({round, round, round}, 0)});
  }
  return parts;
}

double mass_of(const std::vector<SolidPart>& parts) {
  double mass = 0;
  for (const SolidPart& part : parts) mass += part.mass;
  return mass;
}

Vec3 centre_of(const std::vector<SolidPart>& parts) {
  Vec3 moment;
  for (const SolidPart& part : parts) moment = moment + part.mass * part.centre;
  return (1 / mass_of(parts)) * moment;
}

/// Squared radius of gyration about a horizontal axis through the centre of mass, m^2.
/// @param across  unit vector perpendicular to the axis.
double gyration(const std::vector<SolidPart>& parts, const Vec3& centre, Vec2 across) {
  // About the centre of mass, by the parallel-axis theorem.
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const SolidPart& p : parts) {
    const Eigen::Vector3d to = in_eigen(p.centre - centre);
    sum += p.mass * (p.spread + to * to.transpose());
  }
  const Eigen::Vector3d aside{across.x, across.y, 0};
  return (aside.dot(sum * aside) + sum(2, 2)) / mass_of(parts);
}

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Corners of the convex hull of the wheels, counter-clockwise (A. M. Andrew, "Another Efficient
/// Algorithm for Convex Hulls in Two Dimensions", 1979).
std::vector<Vec2> support(const std::vector<Wheel>& wheels) {
  std::vector<Vec2> points;
  points.reserve(wheels.size());
  for (const Wheel& wheel : wheels) points.push_back(wheel.position);
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  const auto add = [&hull](Vec2 point, std::size_t kept) {
    while (hull.size() >= kept + 2 &&
           cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Vec2 point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

/// Each wheel's share of the weight, as on equal springs: linear in the wheels' positions.
std::vector<double> loads(const std::vector<Wheel>& wheels, Vec2 centre) {
  const double n = static_cast<double>(wheels.size());
  Vec2 mean;
  for (const Wheel& wheel : wheels) mean = mean + (1 / n) * wheel.position;
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();  // invertible: not all wheels on one line
  for (const Wheel& wheel : wheels) {
    const Eigen::Vector2d to{wheel.position.x - mean.x, wheel.position.y - mean.y};
    moments += to * to.transpose();
  }
  const Eigen::Vector2d off{centre.x - mean.x, centre.y - mean.y};
  const Eigen::Vector2d tilt = moments.ldlt().solve(off);
  const Vec2 slope{tilt.x(), tilt.y()};
  std::vector<double> shares;
  shares.reserve(wheels.size());
  for (const Wheel& wheel : wheels)
    shares.push_back(std::max(0.0, 1 / n + dot(slope, wheel.position - mean)));
  return shares;
}

/// Largest force of a wheel on the ground against a push of the body in a direction, N.
double grip(const Wheel& wheel, double load, Vec2 direction) {
  const Vec2 grip{-math::sin(wheel.slip_heading()), math::cos(wheel.slip_heading())};
  const double along = std::abs(dot(grip, direction));
  const double across = std::abs(cross(grip, direction));
  const double lever = wheel.radius * math::cos(wheel.roller_angle);
  const double driven =
      wheel.is_driven() ? std::min(wheel.mu * load, wheel.max_torque / lever) : wheel.mu * load;
  // A fixed wheel resists a push along its axle, but its motor cannot push in that direction.
  return along * driven + (wheel.type == WheelType::kFixed ? 0 : across * wheel.mu2 * load);
}

/// Acceleration in a direction that grip and torque of the wheels permit, m/s^2.
double traction(const RobotDescription& robot, const Vec3& centre, double mass, double gravity,
                Vec2 direction) {
  const std::vector<double> shares = loads(robot.wheels, {centre.x, centre.y});
  double force = 0;
  for (std::size_t i = 0; i < shares.size(); ++i)
    force += grip(robot.wheels[i], shares[i] * mass * gravity, direction);
  return force / mass;
}

/// The fastest straight motion that is nearest to a direction.
struct Straight {
  double speed = 0;  ///< m/s along the direction; 0: the wheels allow none.
  /// Component of the body's acceleration limit along the direction, as a share.
  double share = 0;
};
Straight straight(const std::vector<Wheel>& wheels, Vec2 direction) {
  const node::devices::WheelDrive drive(wheels);
  const Twist2 motion = drive.project({direction.x, direction.y, 0});
  const double length = math::hypot(motion.vx, motion.vy);
  if (length < 1e-9) return {};
  double turning = 0;
  for (const double speed : drive.wheel_speeds(motion))
    turning = std::max(turning, std::abs(speed));
  const double along = dot(Vec2{motion.vx, motion.vy}, direction);
  return {drive.max_wheel_speed() / turning * along,
          drive.degrees_of_freedom() == 3 ? 1 : along / length};
}

/// A body that turns about an edge on the ground.
struct Pivot {
  double inside, height;  ///< m, of its centre of mass
  double inertia;         ///< m^2, squared radius of gyration about the edge
  double gravity;         ///< m/s^2
};

/// An interval of constant acceleration away from the edge.
struct Push {
  double acceleration;  ///< m/s^2
  double seconds;
};

/// Acceleration at a time [s], m/s^2; nullopt after the last push.
std::optional<double> push_at(double time, const std::vector<Push>& pushes) {
  double end = 0;
  for (const Push& push : pushes) {
    end += push.seconds;
    if (time < end) return push.acceleration;
  }
  return std::nullopt;
}

/// Whether the body, initially at rest on the ground, tips over the edge.
bool goes_over(const Pivot& pivot, const std::vector<Push>& pushes) {
  constexpr double kStep = 1e-3;   // s; bodies of a metre take some tenths of a second to fall
  constexpr double kLongest = 10;  // s
  const double balance = math::atan2(pivot.inside, pivot.height);  // rad, at which it balances
  double tilt = 0, rate = 0;
  for (double time = 0; time < kLongest; time += kStep) {
    const std::optional<double> push = push_at(time, pushes);
    if (!push && tilt == 0) return false;
    const double c = math::cos(tilt), s = math::sin(tilt);
    const double lever = pivot.inside * c - pivot.height * s;
    const double height = pivot.inside * s + pivot.height * c;
    rate += kStep * (push.value_or(0) * height - pivot.gravity * lever) / pivot.inertia;
    tilt += kStep * rate;
    if (tilt > balance) return true;
    if (tilt <= 0) tilt = rate = 0;
  }
  return false;
}

/// Effect of the robot's motors at one edge.
void drive_over(const RobotDescription& robot, const std::vector<SolidPart>& parts, Vec2 inward,
                double gravity, Stability& result) {
  const auto& limits = robot.acceleration;
  const double most = traction(robot, result.centre_of_mass, mass_of(parts), gravity, inward);
  const auto [speed, share] = straight(robot.wheels, inward);
  if (speed == 0) return;
  const double braking = std::min(limits.linear_down * share, most);
  const double speeding = std::min(limits.linear_up * share, most);
  result.driving = std::max(braking, speeding);
  const double height = result.centre_of_mass.z;
  const double inertia = gyration(parts, result.centre_of_mass, inward) + height * height +
                         result.inside * result.inside;
  result.tips_over = result.driving > result.lifting &&
                     goes_over({result.inside, height, inertia, gravity},
                               {{braking, speed / braking}, {speeding, speed / speeding}});
}

/// Sort key of an edge: the weaker edge is less.
auto strength(const Stability& s) {
  return std::make_tuple(s.inside > 0, !s.tips_over, s.lifting - s.driving);
}

}  // namespace

Stability stability_of(const RobotDescription& robot, double gravity) {
  const std::vector<SolidPart> parts = parts_of(robot);
  Stability weakest{.centre_of_mass = centre_of(parts)};
  const Vec3& centre = weakest.centre_of_mass;
  const std::vector<Vec2> corners = support(robot.wheels);
  if (corners.size() < 3) return weakest;  // all wheels on one line: inside is 0
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
    const double length = std::sqrt(dot(edge, edge));
    const Vec2 inward{-edge.y / length, edge.x / length};
    Stability here{.centre_of_mass = centre};
    here.inside = dot(inward, Vec2{centre.x, centre.y} - corners[i]);
    here.lifting = gravity * here.inside / centre.z;
    if (here.inside > 0) drive_over(robot, parts, inward, gravity, here);
    if (i == 0 || strength(here) < strength(weakest)) weakest = here;
  }
  return weakest;
}

}  // namespace hal::files::description
