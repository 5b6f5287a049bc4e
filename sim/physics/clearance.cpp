#include "sim/physics/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim::physics {
namespace {

using hal::Vec3;

/// m; far above rounding errors, far below a contact's depth.
constexpr double kDoubt = 1e-6;

Vec3 centre_of(dBodyID body) {
  const dReal* p = dBodyGetPosition(body);
  return {p[0], p[1], p[2]};
}

/// Half the diagonal of a geometry, plus its distance from the centre of mass. m
double radius_of(dGeomID geometry) {
  dVector3 half{};
  if (dGeomGetClass(geometry) == dSphereClass) return dGeomSphereGetRadius(geometry);  // a movable
  if (dGeomGetClass(geometry) == dBoxClass) {
    dGeomBoxGetLengths(geometry, half);
    for (double& length : half) length *= 0.5;
  } else {
    dReal length = 0;
    dGeomCylinderGetParams(geometry, &half[0], &length);
    half[1] = 0.5 * length;
  }
  const double size = std::sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
  const dReal* p = dGeomGetPosition(geometry);
  const Vec3 offset = Vec3{p[0], p[1], p[2]} - centre_of(dGeomGetBody(geometry));
  return size + std::sqrt(hal::dot(offset, offset));
}

/// Distance from a point to a wall, 0 inside. m
double distance(const Vec3& point, const Shape& wall) {
  const hal::Vec2 to{point.x - wall.centre.x, point.y - wall.centre.y};
  const double x = std::max(std::abs(hal::dot(to, wall.axis)) - wall.half.x, 0.0);
  const double y = std::max(std::abs(to.y * wall.axis.x - to.x * wall.axis.y) - wall.half.y, 0.0);
  const double z = std::max({wall.z_low - point.z, point.z - wall.z_high, 0.0});
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace

double radius_of(const Object& object) {
  double radius = 0;
  for (const dGeomID geometry : object.geometries) radius = std::max(radius, radius_of(geometry));
  return radius;
}

bool Clearance::may_touch(const Objects& objects) {
  if (!measures(objects)) return true;
  if (crowded_ || has_strayed(objects)) measure(objects);
  return crowded_;
}

bool Clearance::has_strayed(const Objects& objects) const {
  if (balls_.size() != objects.size()) return true;
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    if (!objects[i]->awake()) continue;
    const Vec3 moved = centre_of(objects[i]->rigid.body) - balls_[i].centre;
    // Written so that NaN counts as strayed.
    if (!balls_[i].can_move || !(hal::dot(moved, moved) < balls_[i].free * balls_[i].free))
      return true;
  }
  return false;
}

void Clearance::measure(const Objects& objects) {
  for (std::size_t i = balls_.size(); i < objects.size(); ++i)
    balls_.push_back({{}, radius_of(*objects[i]), 0, false});
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    Ball& ball = balls_[i];
    ball.centre = centre_of(objects[i]->rigid.body);
    // A sleeping robot wakes up when it is told to drive; a sleeping mote only when touched.
    ball.can_move = objects[i]->drivetrain != nullptr || objects[i]->awake();
    ball.free = ball.can_move ? gap_to_walls(ball) : std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < i; ++j) measure_between(ball, balls_[j]);
  }
  crowded_ = std::any_of(balls_.begin(), balls_.end(),
                         [](const Ball& ball) { return !(ball.free > kDoubt); });
}

void Clearance::measure_between(Ball& a, Ball& b) const {
  if (!a.can_move && !b.can_move) return;
  const Vec3 between = a.centre - b.centre;
  const double gap = std::sqrt(hal::dot(between, between)) - a.radius - b.radius;
  a.free = std::min(a.free, 0.5 * gap);
  b.free = std::min(b.free, 0.5 * gap);
}

double Clearance::gap_to_walls(const Ball& ball) const {
  if (!tree_.is_empty()) {
    const auto to_wall = [&](std::uint32_t i) { return distance(ball.centre, walls_[i]); };
    return tree_.nearest({ball.centre.x, ball.centre.y}, to_wall) - ball.radius;
  }
  double gap = std::numeric_limits<double>::infinity();
  for (const Shape& wall : walls_) gap = std::min(gap, distance(ball.centre, wall) - ball.radius);
  return gap;
}

}  // namespace sim::physics
