#include "sim/sensing/ray_fan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/sensing/sector_query.h"

namespace sim::sensing {
namespace {

using hal::Vec2;
using physics::Shape;

/// m; nearer than this a shape may be seen under any angle.
constexpr double kNear = 1e-3;
/// By this a shape's limits are widened: far above what rounding does at a distance of kNear.
constexpr double kDoubt = 1e-6;

double cross_of(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// The half lengths of an upright box around a shape, along its axes.
Vec2 half_of(const Shape& shape) {
  return shape.kind == Shape::Kind::kBox ? shape.half : Vec2{shape.radius, shape.radius};
}

}  // namespace

RayFan::RayFan(const std::vector<double>& headings)
    : directions_(headings.size()), in_order_(headings.size()) {
  for (const double heading : headings) rays_.push_back(unit(heading));
  std::iota(in_order_.begin(), in_order_.end(), 0U);
  std::ranges::stable_sort(in_order_, {}, [this](std::uint32_t i) { return number_of(rays_[i]); });
  for (const std::uint32_t i : in_order_) numbers_.push_back(number_of(rays_[i]));
}

/// 0 along x, 1 along y, and so on: the share of the way around a square on its corner.
double RayFan::number_of(Vec2 direction) {
  const double share = direction.y / (std::abs(direction.x) + std::abs(direction.y));
  if (direction.x < 0) return 2 - share;
  return direction.y < 0 ? kTurn + share : share;
}

/// The angles of the two outermost corners of the box around a shape. Seen from outside, corners
/// are within half a turn, so that cross products put them in order.
RayFan::Seen RayFan::seen(const Shape& shape, Vec2 origin) const {
  const Vec2 half = half_of(shape);
  const Vec2 along = half.x * shape.axis;
  const Vec2 across = half.y * Vec2{-shape.axis.y, shape.axis.x};
  const Vec2 centre = shape.centre - origin;
  const bool is_inside = std::abs(hal::dot(centre, shape.axis)) <= half.x + kNear &&
                         std::abs(cross_of(shape.axis, centre)) <= half.y + kNear;
  if (is_inside) return {};
  const std::array corners{centre + along + across, centre + along - across,
                           centre - along + across, centre - along - across};
  Vec2 right = corners[0], left = corners[0];
  for (const Vec2 corner : {corners[1], corners[2], corners[3]}) {
    if (cross_of(right, corner) < 0) right = corner;
    if (cross_of(left, corner) > 0) left = corner;
  }
  const Vec2 back{ahead_.x, -ahead_.y};
  Seen angles{number_of(turned(right, back)) - kDoubt, number_of(turned(left, back)) + kDoubt};
  if (angles.to < angles.from) angles.to += kTurn;
  return angles;
}

void RayFan::test(const Shape& shape, Vec2 origin, std::vector<double>& ranges) const {
  const Seen angles = seen(shape, origin);
  const std::size_t count = numbers_.size();
  auto next = static_cast<std::size_t>(
      std::ranges::lower_bound(numbers_, std::max(angles.from, 0.0)) - numbers_.begin());
  double turns = 0;
  if (angles.from < 0) {  // begins with the last rays of the turn before
    next = static_cast<std::size_t>(std::ranges::lower_bound(numbers_, angles.from + kTurn) -
                                    numbers_.begin());
    turns = -kTurn;
  }
  for (std::size_t tested = 0; tested < count; ++tested, ++next) {
    if (next == count) {
      next = 0;
      turns += kTurn;
    }
    if (numbers_[next] + turns > angles.to) return;
    const std::uint32_t ray = in_order_[next];
    const auto chord = inside(shape, origin, directions_[ray]);
    if (chord && chord->to >= 0) ranges[ray] = std::min(ranges[ray], std::max(chord->from, 0.0));
  }
}

std::vector<double> RayFan::ranges(const hal::Vec3& origin, Vec2 ahead,
                                   std::span<const Shape> shapes,
                                   std::span<const std::size_t> candidates, hal::AgentId own) {
  ahead_ = ahead;
  for (std::size_t i = 0; i < rays_.size(); ++i) directions_[i] = turned(rays_[i], ahead);
  std::vector<double> ranges(rays_.size(), std::numeric_limits<double>::infinity());
  for (const std::size_t index : candidates) {
    const Shape& shape = shapes[index];
    if (shape.owner == own && own != hal::AgentId{}) continue;
    if (origin.z < shape.z_low || origin.z > shape.z_high) continue;
    test(slice(shape, origin.z), {origin.x, origin.y}, ranges);
  }
  return ranges;
}

}  // namespace sim::sensing
