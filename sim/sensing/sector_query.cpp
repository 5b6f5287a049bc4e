#include "sim/sensing/sector_query.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace sim::sensing {
namespace {

using hal::Vec2;
using physics::Shape;

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
double length(Vec2 a) { return std::sqrt(hal::dot(a, a)); }

/// Convert a vector to and from the frame of a box's own axes.
Vec2 to_box(const Shape& box, Vec2 v) { return {hal::dot(v, box.axis), cross(box.axis, v)}; }
Vec2 from_box(const Shape& box, Vec2 v) {
  return {v.x * box.axis.x - v.y * box.axis.y, v.x * box.axis.y + v.y * box.axis.x};
}

std::optional<Interval> inside_circle(const Shape& shape, Vec2 origin, Vec2 direction) {
  const double size = length(direction);
  const Vec2 to_centre = shape.centre - origin;
  const double miss = cross(direction, to_centre) / size;
  if (std::abs(miss) > shape.radius) return std::nullopt;
  const double middle = hal::dot(direction, to_centre) / size;
  const double half_chord = std::sqrt(shape.radius * shape.radius - miss * miss);
  return Interval{(middle - half_chord) / size, (middle + half_chord) / size};
}

/// Narrows an interval to where |start + t * slope| <= half. @return false if it becomes empty.
bool clip(Interval& interval, double start, double slope, double half) {
  if (slope == 0) return std::abs(start) <= half;
  const double a = (-half - start) / slope;
  const double b = (half - start) / slope;
  interval.from = std::max(interval.from, std::min(a, b));
  interval.to = std::min(interval.to, std::max(a, b));
  return interval.from <= interval.to;
}

std::optional<Interval> inside_box(const Shape& shape, Vec2 origin, Vec2 direction) {
  const Vec2 start = to_box(shape, origin - shape.centre);
  const Vec2 slope = to_box(shape, direction);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Interval interval{-kFar, kFar};
  if (!clip(interval, start.x, slope.x, shape.half.x)) return std::nullopt;
  if (!clip(interval, start.y, slope.y, shape.half.y)) return std::nullopt;
  return interval;
}

}  // namespace

Vec2 unit(double heading) { return {hal::math::cos(heading), hal::math::sin(heading)}; }

Shape slice(const Shape& shape, double z) {
  Shape cut = shape;
  if (shape.kind != Shape::Kind::kSphere) return cut;
  const double above = z - 0.5 * (shape.z_low + shape.z_high);
  cut.kind = Shape::Kind::kCylinder;
  cut.radius = std::sqrt(std::max(shape.radius * shape.radius - above * above, 0.0));
  return cut;
}

std::optional<Interval> inside(const Shape& shape, Vec2 origin, Vec2 direction) {
  return shape.kind == Shape::Kind::kBox ? inside_box(shape, origin, direction)
                                         : inside_circle(shape, origin, direction);
}

Vec2 to_nearest(const Shape& shape, Vec2 origin) {
  const Vec2 to_centre = shape.centre - origin;
  if (shape.kind != Shape::Kind::kBox) {
    const double distance = length(to_centre);
    if (distance <= shape.radius) return {};
    return (1 - shape.radius / distance) * to_centre;
  }
  const Vec2 seen = to_box(shape, Vec2{} - to_centre);
  const Vec2 nearest{std::clamp(seen.x, -shape.half.x, shape.half.x),
                     std::clamp(seen.y, -shape.half.y, shape.half.y)};
  return from_box(shape, nearest - seen);
}

Interval extent_along(const Shape& shape, Vec2 origin, Vec2 direction) {
  const double middle = hal::dot(shape.centre - origin, direction);
  const Vec2 own = to_box(shape, direction);
  const double half = shape.kind == Shape::Kind::kBox
                          ? shape.half.x * std::abs(own.x) + shape.half.y * std::abs(own.y)
                          : shape.radius;
  return {middle - half, middle + half};
}

SectorQuery::SectorQuery(const Sector& sector)
    : SectorQuery(sector.origin, unit(sector.heading), unit(sector.half_angle), sector.range) {}

SectorQuery::SectorQuery(const hal::Vec3& from, Vec2 middle, Vec2 half_angle, double range)
    : origin_(from),
      range_(range),
      half_(half_angle),
      middle_(middle),
      left_(turned(middle, half_angle)),
      right_(turned(middle, {half_angle.x, -half_angle.y})) {
  BARAKA_CHECK(range > 0 && half_.x > 0 && half_.y >= 0);
  const Vec2 origin{origin_.x, origin_.y};
  bounds_ = {origin_, origin_};
  const auto include = [&](Vec2 direction) {
    const Vec2 tip = origin + range_ * direction;
    bounds_.low = {std::min(bounds_.low.x, tip.x), std::min(bounds_.low.y, tip.y), origin_.z};
    bounds_.high = {std::max(bounds_.high.x, tip.x), std::max(bounds_.high.y, tip.y), origin_.z};
  };
  include(left_);
  include(right_);
  for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}})
    if (contains_bearing(axis)) include(axis);
}

bool SectorQuery::contains_bearing(Vec2 point) const {
  const double along = hal::dot(middle_, point);
  return along > 0 && std::abs(cross(middle_, point)) * half_.x <= along * half_.y;
}

std::optional<double> SectorQuery::nearest(const Shape& shape) const {
  if (origin_.z < shape.z_low || origin_.z > shape.z_high) return std::nullopt;
  if (shape.kind == Shape::Kind::kSphere) return nearest(slice(shape, origin_.z));
  const Vec2 origin{origin_.x, origin_.y};
  const Vec2 nearest_point = to_nearest(shape, origin);
  const double distance = length(nearest_point);
  if (distance > range_) return std::nullopt;
  if (distance == 0 || contains_bearing(nearest_point)) return distance;
  std::optional<double> hit;
  for (const Vec2 edge : {left_, right_}) {
    const auto chord = inside(shape, origin, edge);
    if (!chord || chord->from < 0 || chord->from > range_) continue;
    if (!hit || chord->from < *hit) hit = chord->from;
  }
  return hit;
}

}  // namespace sim::sensing
