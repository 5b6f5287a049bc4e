#include "sim/sensing/line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/sensing/sector_query.h"
#include "sim/sensing/shape_tree.h"

namespace sim::sensing {
namespace {

using hal::Vec2;
using hal::Vec3;
using physics::Shape;

std::vector<Shape> walls_of(const physics::World& world) {
  std::vector<Shape> walls;
  for (const Shape& shape : world.shapes())
    if (shape.is_static()) walls.push_back(shape);
  return walls;
}

std::vector<std::size_t> all_of(const std::vector<Shape>& walls) {
  std::vector<std::size_t> indices(walls.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = i;
  return indices;
}

/// Narrows an interval to the part of the line between the lower and the upper face.
bool clip_height(Interval& part, double start, double slope, const Shape& shape) {
  if (slope == 0) return start > shape.z_low && start < shape.z_high;
  const double a = (shape.z_low - start) / slope;
  const double b = (shape.z_high - start) / slope;
  part.from = std::max(part.from, std::min(a, b));
  part.to = std::min(part.to, std::max(a, b));
  return part.from < part.to;
}

double share_in_sphere(const Shape& sphere, const Vec3& from, const Vec3& slope) {
  const double z = 0.5 * (sphere.z_low + sphere.z_high);
  const Vec3 to = Vec3{sphere.centre.x, sphere.centre.y, z} - from;
  const double squared = hal::dot(slope, slope);
  if (squared == 0) return 0;
  const double middle = hal::dot(to, slope) / squared;
  const double room =
      (sphere.radius * sphere.radius - hal::dot(to, to)) / squared + middle * middle;
  if (room <= 0) return 0;
  const double half = std::sqrt(room);
  return std::max(0.0, std::min(1.0, middle + half) - std::max(0.0, middle - half));
}

/// Share of the segment inside the shape, 0 .. 1.
double share_inside(const Shape& shape, const Vec3& from, const Vec3& slope) {
  if (shape.kind == Shape::Kind::kSphere) return share_in_sphere(shape, from, slope);
  Interval part{0, 1};
  if (!clip_height(part, from.z, slope.z, shape)) return 0;
  const Vec2 start{from.x, from.y};
  const Vec2 direction{slope.x, slope.y};
  const double tiny = 1e-12;
  if (hal::dot(direction, direction) <
      tiny) {  // A vertical line: inside all the way or not at all.
    const auto line = inside(shape, start, {1, 0});
    return line && line->from < 0 && line->to > 0 ? part.to - part.from : 0;
  }
  const auto line = inside(shape, start, direction);
  if (!line) return 0;
  return std::max(0.0, std::min(part.to, line->to) - std::max(part.from, line->from));
}

}  // namespace

double length_inside(const Shape& shape, const Vec3& from, const Vec3& to) {
  const Vec3 slope = to - from;
  return share_inside(shape, from, slope) * std::sqrt(hal::dot(slope, slope));
}

class LineOfSight::Implementation {
 public:
  explicit Implementation(const physics::World& world)
      : walls(walls_of(world)), tree(walls, all_of(walls)) {}

  std::vector<Shape> walls;
  ShapeTree tree;
  std::vector<std::size_t> candidates;
  std::vector<Wall> crossed;
};

LineOfSight::LineOfSight(const physics::World& world)
    : implementation_(std::make_unique<Implementation>(world)) {}

LineOfSight::~LineOfSight() = default;

std::span<const LineOfSight::Wall> LineOfSight::walls_between(const Vec3& from,
                                                              const Vec3& to) const {
  auto& [walls, tree, candidates, crossed] = *implementation_;
  candidates.clear();
  crossed.clear();
  if (from != to) tree.along(from, to, candidates);
  for (const std::size_t index : candidates) {
    const double length = length_inside(walls[index], from, to);
    if (length > 0) crossed.push_back({index, length});
  }
  return crossed;
}

Crossing LineOfSight::between(const Vec3& from, const Vec3& to) const {
  Crossing crossing;
  for (const Wall& wall : walls_between(from, to)) {
    ++crossing.walls;
    crossing.thickness += wall.thickness;
  }
  return crossing;
}

}  // namespace sim::sensing
