#include "sim/sensing/proximity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/core/cell_grid.h"
#include "sim/physics/wall_tree.h"
#include "sim/sensing/shape_tree.h"

namespace sim::sensing {
namespace {

using physics::Shape;

/// m; edge of the cells for moving shapes: similar to a sensor's range and a robot's size.
constexpr double kCell = 1;

std::vector<std::size_t> fixed_among(std::span<const Shape> shapes) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (shapes[i].is_static()) chosen.push_back(i);
  return chosen;
}

/// End of the shapes of one body, whose indices are consecutive.
std::size_t end_of_body(std::span<const Shape> shapes, std::size_t first) {
  std::size_t end = first + 1;
  while (end < shapes.size() && shapes[end].is_of_body(shapes[first])) ++end;
  return end;
}

/// Radius of a circle around the centre that encloses the shape, seen from above. m
double radius_of(const Shape& shape) {
  if (shape.kind != Shape::Kind::kBox) return shape.radius;
  return std::sqrt(hal::dot(shape.half, shape.half));
}

}  // namespace

class Proximity::Implementation {
 public:
  explicit Implementation(const physics::World& given)
      : world(given), fixed(given.shapes(), fixed_among(given.shapes())) {
    for (const Shape& shape : given.shapes())
      if (shape.is_static()) walls.push_back(shape);
    if (walls.size() >= physics::WallTree::kFewestWalls) tree = physics::WallTree(walls);
    follow_all();
  }

  /// Updates the entry of a body: the place of its first shape. @return the end of its shapes.
  std::size_t follow(std::span<const Shape> shapes, std::size_t first) {
    const hal::Vec2 place = shapes[first].centre;
    const std::size_t end = end_of_body(shapes, first);
    for (std::size_t i = first; i < end; ++i) {
      const hal::Vec2 away = shapes[i].centre - place;
      largest = std::max(largest, std::sqrt(hal::dot(away, away)) + radius_of(shapes[i]));
    }
    moving.put(static_cast<CellGrid::Member>(first), place);
    return end;
  }
  void follow_all() {
    const std::span<const Shape> shapes = world.shapes();
    for (std::size_t i = 0; i < shapes.size();)
      i = shapes[i].is_static() ? i + 1 : follow(shapes, i);
    followed = world.steps();
  }
  void follow_moved() {
    const std::span<const Shape> shapes = world.shapes();
    for (const hal::AgentId agent : world.moved())
      follow(shapes, static_cast<std::size_t>(world.shapes_of(agent).data() - shapes.data()));
    for (const std::uint32_t i : world.moved_movables())
      follow(shapes, static_cast<std::size_t>(&world.movable_shape(i) - shapes.data()));
    followed = world.steps();
  }

  void add_moving(const Region& region) {
    found.clear();
    moving.within({region.low.x - largest, region.low.y - largest},
                  {region.high.x + largest, region.high.y + largest}, found);
    const std::span<const Shape> shapes = world.shapes();
    for (const CellGrid::Member first : found) {
      const std::size_t end = end_of_body(shapes, first);
      for (std::size_t shape = first; shape < end; ++shape) candidates.push_back(shape);
    }
  }

  const physics::World& world;
  std::vector<Shape> walls;
  physics::WallTree tree;  ///< Of the walls, if they are many.
  ShapeTree fixed;         ///< Built once.
  CellGrid moving{kCell};
  double largest = 0;          ///< m; largest distance from a body's place in `moving` to its edge
  std::uint64_t followed = 0;  ///< Step of the world for which `moving` is valid.
  std::vector<std::size_t> candidates;
  std::vector<CellGrid::Member> found;
};

Proximity::Proximity(const physics::World& world)
    : implementation_(std::make_unique<Implementation>(world)) {}

Proximity::~Proximity() = default;

void Proximity::update() {
  Implementation& i = *implementation_;
  if (i.followed + 1 == i.world.steps())
    i.follow_moved();
  else if (i.followed != i.world.steps())
    i.follow_all();
}

std::span<const std::size_t> Proximity::within(const Region& region) const {
  Implementation& i = *implementation_;
  i.candidates.clear();
  i.fixed.overlapping(region, i.candidates);
  i.add_moving(region);
  std::sort(i.candidates.begin(), i.candidates.end());
  return i.candidates;
}

std::span<const std::size_t> Proximity::moving_within(const Region& region) const {
  Implementation& i = *implementation_;
  i.candidates.clear();
  i.add_moving(region);
  std::sort(i.candidates.begin(), i.candidates.end());
  return i.candidates;
}

const physics::WallTree& Proximity::wall_tree() const { return implementation_->tree; }

std::span<const Shape> Proximity::walls() const { return implementation_->walls; }

std::optional<double> Proximity::nearest(const SectorQuery& query, hal::AgentId own,
                                         std::span<const std::size_t> candidates) const {
  const std::span<const Shape> shapes = implementation_->world.shapes();
  std::optional<double> smallest;
  for (const std::size_t index : candidates) {
    const Shape& shape = shapes[index];
    if (shape.owner == own && own != hal::AgentId{}) continue;
    const std::optional<double> distance = query.nearest(shape);
    if (distance && (!smallest || *distance < *smallest)) smallest = distance;
  }
  return smallest;
}

}  // namespace sim::sensing
