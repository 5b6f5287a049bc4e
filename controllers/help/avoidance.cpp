#include "controllers/help/avoidance.h"

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"

namespace controllers {
namespace {

using hal::Vec2;
using namespace std::chrono_literals;

constexpr double kPickSideAt = 0.40;    // m of gap along the way
constexpr double kBraking = 0.5;        // m/s^2; below the motors' limit, as a margin
constexpr double kKeepingGain = 1.0;    // 1/s, from an error of the gap to a speed
constexpr double kKeepingSpeed = 0.25;  // m/s
constexpr double kTooNear = 0.20;       // m of gap, below which the robot is pushed away
constexpr double kPush = 0.5;           // m/s, largest speed of that push
constexpr double kTurningGain = 1.0;    // 1/s
constexpr double kTurningSpeed = 0.4;   // rad/s
constexpr double kPatience = 30;        // m along a wall before the first change of side
constexpr std::chrono::duration<double> kSoftStart = 800ms;
constexpr auto kSameWall = 5s;  // after a shorter interval it is the same wall and side

Vec2 left_of(Vec2 v) { return {-v.y, v.x}; }
double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
double length(Vec2 v) { return std::sqrt(hal::dot(v, v)); }
Vec2 unit(Vec2 v) { return 1 / length(v) * v; }

/// To the frame whose x axis is `way`, and back.
Vec2 to_way_frame(Vec2 way, Vec2 v) { return {hal::dot(way, v), cross(way, v)}; }
Vec2 from_way_frame(Vec2 way, Vec2 v) { return v.x * way + v.y * left_of(way); }

/// Normal of the straight surface through two points, towards the robot.
Vec2 normal_through(Vec2 a, Vec2 b) {
  const Vec2 normal = unit(left_of(b - a));
  return hal::dot(normal, a) > 0 ? -1.0 * normal : normal;
}

/// Turning rate that makes the nearest sensor face the direction of travel.
double turn_to_face(Vec2 velocity, const std::vector<hal::InfraredReading>& infrared) {
  if (length(velocity) < 1e-3) return 0;
  const double drive = hal::math::atan2(velocity.y, velocity.x);
  double off = hal::math::kPi;
  for (const auto& [heading, range] : infrared) {
    const double angle = hal::math::wrap_angle(drive - heading);
    if (std::abs(angle) < std::abs(off)) off = angle;
  }
  return infrared.empty() ? 0 : std::clamp(kTurningGain * off, -kTurningSpeed, kTurningSpeed);
}

}  // namespace

hal::Twist2 Avoidance::steer(Vec2 way, const std::vector<hal::InfraredReading>& infrared,
                             hal::Time now) {
  const Points seen = points_of(infrared);
  update_state(way, seen, now);
  Vec2 velocity = following_ ? along_wall(way, seen, now) : towards_point(way, seen);
  velocity = away_from_near(velocity, seen);
  const double too_fast = length(velocity) / limits_.speed;
  if (too_fast > 1) velocity = 1 / too_fast * velocity;
  return {velocity.x, velocity.y, turn_to_face(velocity, infrared)};
}

Avoidance::Points Avoidance::points_of(const std::vector<hal::InfraredReading>& infrared) const {
  Points points;
  for (const auto& [heading, range] : infrared) {
    if (std::isnan(range)) continue;
    const double distance = limits_.body_radius + range;
    points.push_back({distance * hal::math::cos(heading), distance * hal::math::sin(heading)});
  }
  std::ranges::stable_sort(points, {}, length);
  return points;
}

/// Gap between the body and the first surface in a strip along a direction.
/// @param width  of the strip, to each side.
std::optional<double> Avoidance::gap_along(Vec2 direction, const Points& seen, double width) const {
  std::optional<double> gap;
  for (const Vec2 point : seen) {
    const double ahead = hal::dot(direction, point);
    if (ahead <= 0 || std::abs(cross(direction, point)) >= width) continue;
    gap = std::min(gap.value_or(ahead), ahead - limits_.body_radius);
  }
  return gap;
}

void Avoidance::update_state(Vec2 way, const Points& seen, hal::Time now) {
  const auto gap = gap_along(way, seen, wall_width());
  if (!following_) {
    if (gap && *gap < kPickSideAt) start_following(way, seen, now);
    return;
  }
  last_following_ = now;
  look_at_wall(way, seen);
  if (gap) last_blocked_ = now;
  if (now - last_blocked_ >= limits_.clear_for) following_ = false;
  if (now - side_since_ >= patience_) {
    side_ = -side_;
    side_since_ = now;
    patience_ *= 2;
  }
}

void Avoidance::start_following(Vec2 way, const Points& seen, hal::Time now) {
  following_ = true;
  following_since_ = now;
  last_blocked_ = now;
  normal_ = to_way_frame(way, -1.0 * unit(seen.front()));
  look_at_wall(way, seen);
  const bool same_wall = last_following_ && now - *last_following_ < kSameWall;
  last_following_ = now;
  if (same_wall) return;
  // Picks the side that leads towards the point, or the wall to the left if neither does.
  side_ = left_of(normal_).x >= 0 ? 1 : -1;
  side_since_ = now;
  patience_ = hal::from_seconds(kPatience / limits_.speed);
}

void Avoidance::look_at_wall(Vec2 way, const Points& seen) {
  if (seen.empty()) return;
  if (seen.size() > 1) {
    normal_ = to_way_frame(way, normal_through(seen[0], seen[1]));
    return;
  }
  // One point does not determine a wall: at the wall's end the last sensor looks back at it. So the
  // normal is kept unless the point is off the wall.
  constexpr double kOnTheWall = 0.3;  // cosine of the angle to the wall's normal
  const Vec2 towards_robot = to_way_frame(way, -1.0 * unit(seen[0]));
  if (hal::dot(towards_robot, normal_) < kOnTheWall) normal_ = towards_robot;
}

Vec2 Avoidance::towards_point(Vec2 way, const Points& seen) const {
  const auto gap = gap_along(way, seen, wall_width());
  if (!gap) return limits_.speed * way;
  // Speed from which the robot comes to rest slightly beyond the distance at which it picks a side,
  // so that it gets there: v = sqrt(2 a s), with constant braking a over the distance s.
  constexpr double kRestAt = kPickSideAt - 0.05;
  const double speed = std::sqrt(2 * kBraking * std::max(0.0, *gap - kRestAt));
  return std::min(speed, limits_.speed) * way;
}

Vec2 Avoidance::along_wall(Vec2 way, const Points& seen, hal::Time now) const {
  const Vec2 normal = from_way_frame(way, normal_);
  const Vec2 tangent = side_ * left_of(normal);
  // Something ahead slows the robot down; it becomes the wall when it is the nearest surface.
  const auto ahead = gap_along(tangent, seen, limits_.body_radius + 0.05);
  const double room = ahead ? std::clamp((*ahead - 0.1) / 0.4, 0.0, 1.0) : 1.0;
  // A soft start: motors that share their acceleration between braking and accelerating would
  // otherwise continue into the wall.
  const double start = std::min(1.0, (now - following_since_) / kSoftStart);
  double keeping = 0;
  if (!seen.empty()) {
    const double error = wall_width() + hal::dot(normal, seen.front());
    keeping = std::clamp(kKeepingGain * error, -kKeepingSpeed, kKeepingSpeed);
  }
  return std::min(room, start) * limits_.speed * tangent + keeping * normal;
}

Vec2 Avoidance::away_from_near(Vec2 velocity, const Points& seen) const {
  for (const Vec2 point : seen) {
    const double gap = length(point) - limits_.body_radius;
    if (gap >= kTooNear) continue;
    velocity = velocity - kPush * (kTooNear - gap) / kTooNear * unit(point);
  }
  return velocity;
}

}  // namespace controllers
