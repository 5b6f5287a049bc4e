#include "sim/sensing/ray_fan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/physics/wall_tree.h"
#include "sim/sensing/sector_query.h"

namespace sim::sensing {
namespace {

using hal::Vec2;
using physics::Shape;

constexpr double kMiss = std::numeric_limits<double>::infinity();
constexpr double kTurn = 4;
/// m; nearer than this a shape may be seen under any angle.
constexpr double kNear = 1e-3;
/// By this a shape's limits are widened: far above what rounding does at a distance of kNear.
constexpr double kDoubt = 1e-6;

double cross_of(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// A number that grows with a direction's angle, without trigonometry: 0 along x, 1 along y, and so
/// on; the share of the way around a square on its corner. 0 .. kTurn
double number_of(Vec2 direction) {
  const double share = direction.y / (std::abs(direction.x) + std::abs(direction.y));
  if (direction.x < 0) return 2 - share;
  return direction.y < 0 ? kTurn + share : share;
}

}  // namespace

RayFan::RayFan(const std::vector<double>& headings, double reach)
    : directions_(headings.size()),
      found_(headings.size()),
      places_(headings.size()),
      reach_(reach) {
  std::vector<Vec2> rays;
  rays.reserve(headings.size());
  for (const double heading : headings) rays.push_back(unit(heading));
  std::iota(places_.begin(), places_.end(), std::size_t{0});
  std::ranges::stable_sort(places_, {}, [&](std::size_t i) { return number_of(rays[i]); });
  for (const std::size_t i : places_) {
    rays_.push_back(rays[i]);
    numbers_.push_back(number_of(rays[i]));
  }
}

RayFan::Block RayFan::block_around(const Shape& shape) {
  const bool is_box = shape.kind == Shape::Kind::kBox;
  return {shape.centre, is_box ? shape.axis : Vec2{1, 0},
          is_box ? shape.half : Vec2{shape.radius, shape.radius}};
}

/// The rays between the two outermost corners. Seen from outside, corners are within half a turn,
/// so that cross products put them in order.
RayFan::Parts RayFan::rays_to(const Block& block) const {
  const Part all{0, rays_.size()};
  const Vec2 centre = block.centre - Vec2{origin_.x, origin_.y};
  if (std::abs(hal::dot(centre, block.axis)) <= block.half.x + kNear &&
      std::abs(cross_of(block.axis, centre)) <= block.half.y + kNear)
    return {all, Part{}};
  const Vec2 along = block.half.x * block.axis;
  const Vec2 across = block.half.y * Vec2{-block.axis.y, block.axis.x};
  const std::array corners{centre + along + across, centre + along - across,
                           centre - along + across, centre - along - across};
  Vec2 right = corners[0], left = corners[0];
  for (const Vec2 corner : {corners[1], corners[2], corners[3]}) {
    if (cross_of(right, corner) < 0) right = corner;
    if (cross_of(left, corner) > 0) left = corner;
  }
  const Vec2 back{ahead_.x, -ahead_.y};
  const double from = number_of(turned(right, back)) - kDoubt;
  const double to = number_of(turned(left, back)) + kDoubt;
  const auto first = [&](double number) {
    return static_cast<std::size_t>(std::ranges::lower_bound(numbers_, number) - numbers_.begin());
  };
  if (from < 0) return {Part{0, first(to)}, Part{first(from + kTurn), rays_.size()}};
  if (to > kTurn) return {Part{0, first(to - kTurn)}, Part{first(from), rays_.size()}};
  if (from > to) return {Part{0, first(to)}, Part{first(from), rays_.size()}};
  return {Part{first(from), first(to)}, Part{}};
}

void RayFan::test(const Shape& shape) {
  for (const auto& [first, end] : rays_to(block_around(shape))) {
    for (std::size_t ray = first; ray < end; ++ray) {
      const auto chord = inside(shape, {origin_.x, origin_.y}, directions_[ray]);
      if (chord && chord->to >= 0) found_[ray] = std::min(found_[ray], std::max(chord->from, 0.0));
    }
  }
}

/// Whether all rays that may meet a block end before it.
bool RayFan::is_hidden(const Block& block, double distance) const {
  for (const auto& [first, end] : rays_to(block)) {
    for (std::size_t ray = first; ray < end; ++ray)
      if (found_[ray] > distance - kDoubt) return false;
  }
  return true;
}

void RayFan::test_walls(const Proximity& proximity) {
  const std::span<const Shape> walls = proximity.walls();
  proximity.wall_tree().visit(
      {origin_.x, origin_.y},
      [&](const physics::Outline& outline, double distance) {
        if (distance > reach_ + kDoubt) return true;
        return is_hidden(
            {0.5 * (outline.low + outline.high), {1, 0}, 0.5 * (outline.high - outline.low)},
            distance);
      },
      [&](std::uint32_t i) {
        if (origin_.z >= walls[i].z_low && origin_.z <= walls[i].z_high) test(walls[i]);
      });
}

std::vector<double> RayFan::ranges(const hal::Vec3& origin, Vec2 ahead, const Proximity& proximity,
                                   std::span<const Shape> shapes, hal::AgentId own) {
  origin_ = origin;
  ahead_ = ahead;
  std::ranges::fill(found_, kMiss);
  for (std::size_t i = 0; i < rays_.size(); ++i) directions_[i] = turned(rays_[i], ahead);
  const bool has_many_walls = !proximity.wall_tree().is_empty();
  if (has_many_walls) test_walls(proximity);
  const Region around{{origin.x - reach_, origin.y - reach_, origin.z},
                      {origin.x + reach_, origin.y + reach_, origin.z}};
  for (const std::size_t index :
       has_many_walls ? proximity.moving_within(around) : proximity.within(around)) {
    const Shape& shape = shapes[index];
    if (shape.owner == own && own != hal::AgentId{}) continue;
    if (origin.z < shape.z_low || origin.z > shape.z_high) continue;
    test(slice(shape, origin.z));
  }
  std::vector<double> ranges(found_.size());
  for (std::size_t i = 0; i < found_.size(); ++i) ranges[places_[i]] = found_[i];
  return ranges;
}

}  // namespace sim::sensing
